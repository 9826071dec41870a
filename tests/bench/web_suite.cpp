#include <stdio.h>
#include <stdlib.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bench/bench.hpp"
#include "bench/machine_rows.hpp"
#include "bench/pecking.hpp"
#include "bench/script_figures.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
using nlohmann::json;
namespace fs = std::filesystem;
namespace {

constexpr double press_n = 52.0;
/// As long as the reamer stays in the vault in bone half as soft as usual.
constexpr double usual_s = 120.0, half = 0.5;
/// Longer than anybody watches here, and so hard a bone and so slow a reamer that it stays in the vault.
constexpr double long_s = 3600.0, hard = 0.1, slow_rpm = 25.0;

/// The demo's glenoid with a surface of 67 and of 490 thousand triangles.
constexpr double coarse_mm = 0.5125, fine_mm = 0.379;

void keep_glenoid(const fs::path& data, const std::string& id, double spacing_mm, int upsample) {
  ct::PhantomPreset preset = ct::phantom_preset("demo");
  preset.params.spacing_mm = Vec3::Constant(spacing_mm);
  case_::save_case(ct::make_phantom_case(id, preset.params, upsample), cases_folder(data) / id);
}

/// What the script found, measuring the page of the program beside this one.
json measured(const fs::path& data) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "ream";
  const fs::path script = REAM_BENCH_WEB_SCRIPT;
  const std::string command =
      "REAM_BIN=" + shell_word(program) + " node " + shell_word(script) + " " + shell_word(data);
  return script_figures(
      command,
      "the page could not be measured, see above; it takes node, Chromium (REAM_CHROMIUM) and a "
      "built page (scripts/build)");
}

/// What the page is held to.
constexpr double share_of_bare_goal = 0.8, join_goal_s = 1.0, script_goal_ms = 16.0, heap_goal_mb = 10.0,
                 hand_goal_ms = 100.0, most_times_bare = 2.5;

std::string figure(const char* format, double value) {
  std::array<char, 64> text;
  ::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// Both pages draw in turns while one session goes on.
void add_frame_rows(const json& figures, const std::string& size, std::vector<Row>& rows) {
  if (!figures.contains("frames " + size)) return;
  const json& ours = figures["frames " + size]["ours"];
  const json& bare = figures["frames " + size]["bare"];
  const std::string name = figure("%.0f thousand triangles turn", ours["triangles"].get<double>() / 1000.0) +
                           " beside (baseline) a bare three.js page's, ";
  const double bare_rate = bare["picturesPerS"];
  rows.push_back({"web", name + "pictures a second", ours["picturesPerS"], bare_rate, "1/s",
                  share_of_bare_goal * bare_rate, Goal::at_least});
  rows.push_back(
      {"web", name + "processor of a picture, drawing", ours["drawingMs"], bare["drawingMs"], "ms"});
  rows.push_back({"web", name + "processor of a picture, page", ours["pageMs"], bare["pageMs"], "ms"});
  for (const char* level : {"full", "fine"}) {
    const double rate = figures["frames " + size][level]["picturesPerS"];
    rows.push_back({"web", name + "time of a picture, " + level, 1000.0 / rate, 1000.0 / bare_rate, "ms",
                    most_times_bare * 1000.0 / bare_rate});
  }
}

void add_join_rows(const json& figures, const std::string& size, double goal_s, std::vector<Row>& rows) {
  if (!figures.contains("join " + size)) return;
  const json& join = figures["join " + size];
  rows.push_back({"web", size + " triangles: from asking for the stream to the whole picture",
                  join["joinedMs"].get<double>() / 1000.0, 0.0, "s", goal_s});
  rows.push_back({"web", size + " triangles: from the page's address to the whole picture",
                  join["openedMs"].get<double>() / 1000.0, 0.0, "s"});
}

void add_script_rows(const json& figures, std::vector<Row>& rows) {
  if (!figures.contains("script")) return;
  const json& script = figures["script"];
  const std::string name = "67k triangles, live: script of the page in a frame, ";
  rows.push_back({"web", name + "longest, computed", script["longestMs"], 0.0, "ms", script_goal_ms});
  rows.push_back({"web", name + "longest at a stretch, computed", script["longestUnbrokenMs"], 0.0, "ms"});
  rows.push_back({"web", name + "p99, computed", script["p99Ms"], 0.0, "ms"});
  rows.push_back({"web", name + "median, computed", script["medianMs"], 0.0, "ms"});
  rows.push_back(
      {"web", name + "longest, waiting for drawing and processor too", script["longestWallMs"], 0.0, "ms"});
  rows.push_back(
      {"web", name + "p99, waiting for drawing and processor too", script["p99WallMs"], 0.0, "ms"});
  rows.push_back(
      {"web", "67k triangles, live: frames of the page meanwhile", script["framesPerS"], 0.0, "1/s"});
}

void add_heap_rows(const json& figures, std::vector<Row>& rows) {
  if (!figures.contains("heap")) return;
  const json& heap = figures["heap"];
  rows.push_back({"web",
                  "heap of page and workers, live: growth in 30 minutes, from " +
                      figure("%.0f minutes", heap["minutes"]),
                  heap["growthMb"], 0.0, "MB", heap_goal_mb});
  rows.push_back({"web", "heap of page and workers, live: at the end", heap["mb"], 0.0, "MB"});
}

}  // namespace

std::vector<Row> web_suite(const Options&) {
  const test::TemporaryFolder data;
  keep_glenoid(data.path(), "demo", coarse_mm, 1);  // in place of the demo, which the page practises on
  keep_glenoid(data.path(), "fine", fine_mm, 2);
  data.write("scripts/usual.json", pecking(usual_s, press_n, half).dump());
  json for_long = pecking(long_s, press_n, hard);
  for_long["spindle_rpm"] = slow_rpm;
  data.write("scripts/long.json", for_long.dump());
  const json figures = measured(data.path());
  std::vector<Row> rows;
  add_frame_rows(figures, "67k", rows);
  add_frame_rows(figures, "490k", rows);
  add_join_rows(figures, "67k", 0.0, rows);
  add_join_rows(figures, "490k", join_goal_s, rows);
  add_script_rows(figures, rows);
  add_heap_rows(figures, rows);
  if (figures.contains("hand"))
    rows.push_back({"web", "67k triangles: from the sample of a hand on the page to its picture, p95",
                    figures["hand"]["p95Ms"], 0.0, "ms", hand_goal_ms});
  add_machine_rows(rows);
  return rows;
}

}  // namespace ream::bench
