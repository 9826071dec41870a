// Recordings of every revision so far stay readable, and the newest is written as it was on the day it was
// made.
#include <gtest/gtest.h>

#include "support/example_log.hpp"
#include "support/recording_manifest.hpp"
#include "support/temporary_folder.hpp"

namespace ream::record {
namespace {

using test::all_of;
using test::example_op;
using test::example_tick;
using test::golden_recording;

class GoldenRecordingOf : public testing::TestWithParam<uint32_t> {};

TEST_P(GoldenRecordingOf, ARevisionHoldsEveryField) {
  const uint32_t revision = GetParam();
  const OpLogReader log(golden_recording(revision));
  EXPECT_EQ(log.revision(), revision);
  EXPECT_EQ(log.damage(), "");
  EXPECT_EQ(all_of<ops::Header>(log), std::vector{example_op<ops::Header>(7, revision)});
  EXPECT_EQ(all_of<ops::Segment>(log), std::vector{example_op<ops::Segment>(7, revision)});
  EXPECT_EQ(all_of<ops::Event>(log), std::vector{example_op<ops::Event>(7, revision)});
  EXPECT_EQ(all_of<ops::Annotation>(log), std::vector{example_op<ops::Annotation>(7, revision)});
  EXPECT_EQ(all_of<ops::End>(log), std::vector{example_op<ops::End>(7, revision)});
  std::vector<ops::Bricks> bricks;
  std::vector<ops::Checkpoint> checkpoints;
  for (const uint32_t first_tick : {0u, 50u, 100u}) {
    bricks.push_back(example_op<ops::Bricks>(first_tick, revision));
    bricks.back().key = first_tick != 50;
    checkpoints.push_back(example_op<ops::Checkpoint>(first_tick, revision));
  }
  EXPECT_EQ(all_of<ops::Bricks>(log), bricks);
  EXPECT_EQ(all_of<ops::Checkpoint>(log), checkpoints);
  const auto ticks = all_of<ops::Tick>(log);
  ASSERT_EQ(ticks.size(), 130u);
  for (uint32_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i], example_tick(i, revision)) << i;
}

INSTANTIATE_TEST_SUITE_P(Revisions, GoldenRecordingOf, testing::Range(2u, ops::newest_revision + 1));

// Lengths and checksums of the stored bytes depend on the version of zstd; what they hold does not.
TEST(GoldenRecording, OfTheNewestRevisionIsWrittenTheSameWayToday) {
  const OpLogReader golden(golden_recording(ops::newest_revision));
  const test::TemporaryFolder folder;
  test::write_example_log(create_log_file(folder.path() / "recording.ream"));
  const OpLogReader today(folder.path() / "recording.ream");
  ASSERT_EQ(today.chunks().size(), golden.chunks().size());
  for (size_t i = 0; i < today.chunks().size(); ++i) {
    const ChunkPlace &a = today.chunks()[i], &b = golden.chunks()[i];
    EXPECT_EQ(a.raw_bytes, b.raw_bytes) << i;
    EXPECT_EQ(a.first_tick, b.first_tick) << i;
    EXPECT_EQ(a.ticks, b.ticks) << i;
    EXPECT_EQ(a.has_key, b.has_key) << i;
    EXPECT_EQ(a.has_notes, b.has_notes) << i;
    EXPECT_EQ(today.read_chunk(i), golden.read_chunk(i)) << i;
  }
}

TEST(RecordingManifest, ChangesOnlyWithItsRevision) {
  const auto manifest = test::recording_manifest();
  ASSERT_EQ(manifest.at("revision"), ops::newest_revision);
  EXPECT_EQ(test::recorded_structures().at(std::to_string(ops::newest_revision)),
            test::structure_hash(manifest))
      << "proto/recording.json has changed: give it a new revision, new fields that \"since\", and run "
         "make-golden-recording";
}

TEST(RecordingManifest, EveryRevisionHasAGoldenFile) {
  for (uint32_t revision = 2; revision <= ops::newest_revision; ++revision)
    EXPECT_TRUE(std::filesystem::exists(golden_recording(revision))) << revision;
}

TEST(RecordingManifest, WordsDoNotCountAsItsStructure) {
  auto manifest = test::recording_manifest();
  const std::string hash = test::structure_hash(manifest);
  manifest["about"] = "other words";
  manifest["ops"][2]["fields"][0]["about"] = "other words";
  EXPECT_EQ(test::structure_hash(manifest), hash);
  manifest["ops"][2]["fields"][0]["type"] = "u64";
  EXPECT_NE(test::structure_hash(manifest), hash);
}

}  // namespace
}  // namespace ream::record
