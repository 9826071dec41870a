#include <stdio.h>
#include <stdlib.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bench/bench.hpp"
#include "bench/machine_rows.hpp"
#include "bench/pecking.hpp"
#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
using nlohmann::json;
namespace fs = std::filesystem;
namespace {

constexpr double press_n = 52.0;
/// As long as the reamer stays in the vault at the feed of usual bone.
constexpr double usual_s = 60.0;
/// Longer than anybody watches here, and so hard a bone and so slow a reamer that it stays in the vault.
constexpr double long_s = 3600.0, hard = 0.1, slow_rpm = 25.0;

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

/// What the script found, measuring the page of the program beside this one.
json measured(const fs::path& data) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "ream";
  const fs::path script = REAM_BENCH_WEB_SCRIPT;
  const std::string command =
      "REAM_BIN=" + quoted(program) + " node " + quoted(script) + " " + quoted(data);
  FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw Error(ErrorKind::unavailable, "cannot run " + command);
  std::string told;
  std::array<char, 4096> part;
  while (const size_t count = ::fread(part.data(), 1, part.size(), pipe)) told.append(part.data(), count);
  if (::pclose(pipe) != 0)
    throw Error(ErrorKind::unavailable,
                "the page could not be measured, see above; it takes node, Chromium (REAM_CHROMIUM) and a "
                "built page (scripts/build)");
  return json::parse(told);
}

}  // namespace

std::vector<Row> web_suite(const Options&) {
  const test::TemporaryFolder data;
  keep_thesis_case(data.path());
  data.write("scripts/usual.json", pecking(usual_s, press_n).dump());
  json for_long = pecking(long_s, press_n, hard);
  for_long["spindle_rpm"] = slow_rpm;
  data.write("scripts/long.json", for_long.dump());
  const json figures = measured(data.path());
  fprintf(stderr, "%s\n", figures.dump(1).c_str());
  std::vector<Row> rows;
  add_machine_rows(rows);
  return rows;
}

}  // namespace ream::bench
