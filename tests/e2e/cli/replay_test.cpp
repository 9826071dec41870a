#include "e2e/cli/command_line.hpp"
#include "support/changed_recording.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

class Replay : public CommandLine {
 protected:
  void SetUp() override { simulate_short_demo(); }
};

TEST_F(Replay, TellsWhatWasRecordedAndProvesIt) {
  const auto metrics = json_of("run/metrics.json");
  for (const char* name : {"run", "run/recording.ream"}) {
    const auto review = answer({"replay", name});
    EXPECT_EQ(review.at("ticks"), 3000);
    EXPECT_EQ(review.at("state"), "finished");
    EXPECT_EQ(review.at("checkpoints"), 12);
    for (const char* key : {"removed_volume_mm3", "session_hash", "grid_hash"})
      EXPECT_EQ(review.at(key), metrics.at(key)) << key;
  }
  for (const char* backend : {"cpu", "opencl"}) {
    const auto proof = answer({"replay", "run", "--verify", "--backend", backend});
    EXPECT_EQ(proof.at("verified"), true);
    EXPECT_EQ(proof.at("ticks"), 3000);
    EXPECT_EQ(proof.at("grid_hash"), metrics.at("grid_hash"));
  }
  EXPECT_EQ(answer({"replay", "run", "--at", "1.25"}).at("ticks"), 1250);
  EXPECT_EQ(answer({"replay", "run", "--verify", "--at", "0.5"}).at("ticks"), 500);
}

TEST_F(Replay, FindsASessionByItsId) {
  fs::create_directories(folder() / "data/sessions");
  fs::rename(folder() / "run", folder() / "data/sessions/s-1");
  EXPECT_EQ(answer({"replay", "s-1"}).at("ticks"), 3000);
}

TEST_F(Replay, NamesTheFirstTickThatDiffersInOneLine) {
  change_recording(
      folder() / "run/recording.ream", folder() / "other.ream",
      of<record::ops::Tick>([](record::ops::Tick& t) { t.removed_cancellous += t.tick == 1234; }));
  refuse(1, "tick 1234 (1.234 s) differs in bone: removed_cancellous", {"replay", "other.ream", "--verify"});
}

TEST_F(Replay, RefusesWhatItCannotReplay) {
  refuse(1, "nowhere", {"replay", "nowhere"});
  refuse(1, "recording.ream", {"replay", "./data"});
  refuse(2, "--at", {"replay", "run", "--at", "-1"});
  refuse(2, "recording", {"replay"});
}

}  // namespace
}  // namespace ream::test
