#include <sys/stat.h>

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/hash.hpp"
#include "e2e/cli/command_line.hpp"
#include "record/recording.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

class Simulate : public CommandLine {
 protected:
  /// What every finished run leaves in its folder.
  void expect_results(const std::string& out) {
    SCOPED_TRACE(out);
    const auto metrics = json_of(out + "/metrics.json");
    const auto ticks = static_cast<size_t>(std::lround(metrics.at("duration_s").get<double>() * 1000.0));
    EXPECT_GT(metrics.at("removed_volume_mm3").get<double>(), 0.0);
    EXPECT_GT(metrics.at("axial_thrust_peak_n").get<double>(), 0.0);
    EXPECT_EQ(metrics.at("grid_hash").get<std::string>().size(), 16u);
    EXPECT_TRUE(json_of(out + "/timing.json").at("tick_us").at("p999").is_number());

    EXPECT_EQ(text_of(out + "/snapshot.png").substr(1, 3), "PNG");
    EXPECT_EQ(text_of(out + "/reamed.ply").substr(0, 4), "ply\n");
    const std::string trace = text_of(out + "/trace.csv");
    EXPECT_EQ(static_cast<size_t>(std::count(trace.begin(), trace.end(), '\n')), ticks + 1);

    const record::Recording recording(folder() / out / "recording.ream", record::Recording::Trust::checked);
    EXPECT_EQ(recording.log().damage(), "");
    ASSERT_TRUE(recording.end());
    EXPECT_EQ(recording.end()->ticks, ticks);
    ASSERT_EQ(recording.tick_count(), ticks);
    const record::ops::Checkpoint last = recording.checkpoints().back();
    EXPECT_EQ(last.tick, ticks - 1);
    EXPECT_EQ(to_hex(last.session_hash), metrics.at("session_hash"));
    EXPECT_EQ(to_hex(last.grid_hash), metrics.at("grid_hash"));
  }
};

TEST_F(Simulate, WhatIsBelowTheDataFolderIsForItsOwnerAlone) {
  const mode_t before = ::umask(0022);
  succeed({"phantom", "--out", (folder() / "data/phantom").string()});
  succeed(
      {"simulate", "--case", "demo", "--script", short_script(), "--out", "data/run", "--backend", "cpu"});
  ::umask(before);
  size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder() / "data")) {
    ++count;
    EXPECT_EQ(entry.status().permissions() &
                  (std::filesystem::perms::group_all | std::filesystem::perms::others_all),
              std::filesystem::perms::none)
        << entry.path();
  }
  EXPECT_GT(count, 5u);
}

TEST_F(Simulate, TheDemoRemovesBoneAlikeOnEveryBackend) {
  take_demo_case();
  for (const char* backend : {"cpu", "opencl"}) {
    const auto said =
        answer({"simulate", "--case", "demo", "--script", "demo", "--backend", backend, "--out", backend});
    EXPECT_EQ(fs::weakly_canonical(folder() / said.at("out").get<std::string>()),
              fs::canonical(folder() / backend));
    EXPECT_GT(said.at("removed_volume_mm3").get<double>(), 10.0);
    EXPECT_GE(said.at("duration_s").get<double>(), 20.0);
  }
  expect_results("cpu");
  EXPECT_EQ(text_of("opencl/metrics.json"), text_of("cpu/metrics.json"));
}

TEST_F(Simulate, EqualRunsAndEveryBackendGiveTheSameBytes) {
  take_demo_case();
  const std::string script = short_script();
  for (const char* backend : {"cpu", "opencl"})
    for (const char* turn : {"-1", "-2"})
      succeed({"simulate", "--case", "demo", "--script", script, "--backend", backend, "--out",
               std::string(backend) + turn});
  EXPECT_EQ(json_of("cpu-1/metrics.json").at("duration_s"), 3.0);
  expect_results("cpu-1");
  for (const char* out : {"cpu-2", "opencl-1", "opencl-2"})
    for (const char* file : {"/metrics.json", "/trace.csv", "/reamed.ply"})
      EXPECT_EQ(text_of(std::string(out) + file), text_of(std::string("cpu-1") + file)) << out << file;
}

TEST_F(Simulate, RemovalByDecayIsTheSameOnEveryBackendAndSaysSo) {
  take_demo_case();
  const std::string script = short_script();
  for (const char* backend : {"cpu", "opencl"})
    succeed({"simulate", "--case", "demo", "--script", script, "--backend", backend, "--removal", "decay",
             "--out", std::string("decay-") + backend});
  succeed({"simulate", "--case", "demo", "--script", script, "--backend", "cpu", "--out", "profile"});
  expect_results("decay-cpu");
  for (const char* file : {"/metrics.json", "/trace.csv", "/reamed.ply"})
    EXPECT_EQ(text_of(std::string("decay-opencl") + file), text_of(std::string("decay-cpu") + file)) << file;
  EXPECT_EQ(json_of("decay-cpu/session.json").at("removal"), "decay");
  EXPECT_EQ(json_of("decay-cpu/session.json").at("decay_levels"), 16);
  EXPECT_EQ(json_of("profile/session.json").at("removal"), "profile");
  EXPECT_NE(text_of("decay-cpu/reamed.ply"), text_of("profile/reamed.ply"));
  const record::Recording recording(folder() / "decay-cpu/recording.ream");
  EXPECT_EQ(nlohmann::json::parse(recording.header().description).at("removal"), "decay");
}

TEST_F(Simulate, EveryFeedModelSaysSoAndFeedsAsTheSpindleTurns) {
  take_demo_case();
  nlohmann::json script = json_of(short_script());
  script["spindle_rpm"] = 312.0;
  script["specimen_factor"] = 0.95;
  write("fast.json", script.dump());
  double law_mm3 = 0.0;
  for (const char* model : {"thesis", "oblique", "edge"}) {
    SCOPED_TRACE(model);
    const std::string out = std::string("model-") + model;
    succeed({"simulate", "--case", "demo", "--script", "fast.json", "--model", model, "--backend", "cpu",
             "--out", out});
    expect_results(out);
    const auto session = json_of(out + "/session.json");
    const record::Recording recording(folder() / out / "recording.ream");
    const auto header = nlohmann::json::parse(recording.header().description);
    for (const auto& description : {session, header}) {
      EXPECT_EQ(description.at("model"), model);
      EXPECT_EQ(description.at("spindle_rpm"), 312.0);
      EXPECT_EQ(description.at("specimen_factor"), 0.95);
      EXPECT_TRUE(description.contains("feed_table_hash"));
    }
    const double removed_mm3 = json_of(out + "/metrics.json").at("removed_volume_mm3");
    if (std::string(model) == "thesis") law_mm3 = removed_mm3;
    if (std::string(model) == "oblique") {
      EXPECT_NEAR(removed_mm3, law_mm3, 0.04 * law_mm3);
    }
  }
  succeed({"simulate", "--case", "demo", "--script", short_script(), "--model", "thesis", "--out", "slow"});
  EXPECT_LT(json_of("slow/metrics.json").at("removed_volume_mm3").get<double>(), 0.65 * law_mm3);
}

TEST_F(Simulate, WithoutAnOutputFolderItTakesTheNextFreeNumber) {
  take_demo_case();
  const std::string script = short_script();
  for (const char* out : {"ream-out/1", "ream-out/2"}) {
    const Outcome outcome = succeed({"simulate", "--case", "demo", "--script", script, "--backend", "cpu"});
    EXPECT_NE(outcome.out.find(out), std::string::npos) << outcome.out;
    EXPECT_TRUE(fs::exists(folder() / out / "metrics.json"));
  }
}

TEST_F(Simulate, InterruptedItLeavesNothing) {
  take_demo_case();
  const auto before = tree();
  for (const int number : {SIGINT, SIGTERM}) {
    const auto child = start(
        {"simulate", "--case", "demo", "--script", "demo", "--backend", "cpu", "--realtime"}, "interrupted");
    while (tree() == before && !child->ended()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    child->send_signal(number);
    EXPECT_EQ(child->wait(std::chrono::seconds(20)), 1);
    EXPECT_EQ(printed("interrupted.err"), "ream: interrupted; nothing was written\n");
    EXPECT_EQ(tree(), before);
  }
}

}  // namespace
}  // namespace ream::test
