// Recordings of every revision so far stay readable, and the newest is written as it was on the day it was
// made.
#include <gtest/gtest.h>

#include "support/example_log.hpp"
#include "support/expect_error.hpp"
#include "support/recording_manifest.hpp"
#include "support/temporary_folder.hpp"

namespace ream::record {
namespace {

using test::all_of;
using test::example_op;
using test::example_tick;
using test::golden_recording;

TEST(GoldenRecording, OfRevision1HoldsWhatItsWriterWasGiven) {
  const OpLogReader log(golden_recording(1));
  EXPECT_EQ(log.revision(), 1u);
  EXPECT_EQ(log.damage(), "");
  EXPECT_EQ(log.whole_bytes(), std::filesystem::file_size(log.path()));
  const auto headers = all_of<ops::Header>(log);
  ASSERT_EQ(headers.size(), 1u);
  ops::Header expected;
  expected.build = "ream 0.1.0";
  expected.case_id = "demo";
  expected.start_grid_hash = 0x12b9d1a92f62b47a;
  expected.random_seed = 1;
  expected.force_scale = 1.0;
  expected.description = headers[0].description;
  EXPECT_EQ(headers[0], expected);
  EXPECT_EQ(nlohmann::json::parse(expected.description).at("tool_spacing_mm"), 0.2);
  const ops::Segment start{0, "start", "", "ellipse 18.25,9", "", {}, "cpu"};
  EXPECT_EQ(all_of<ops::Segment>(log), std::vector{start});

  const auto ticks = all_of<ops::Tick>(log);
  ASSERT_EQ(ticks.size(), 1040u);
  for (uint32_t i = 0; i < ticks.size(); ++i) {
    const ops::Tick given = example_tick(i, 1);
    ops::Tick kept;
    kept.tick = i;
    kept.flags = given.flags & 7;
    kept.world_from_handle = given.world_from_handle;
    kept.grid_from_tool = given.grid_from_tool;
    kept.session_hash = given.session_hash;
    ASSERT_EQ(ticks[i], kept) << i;
  }
}

TEST(GoldenRecording, OfRevision1SaysWhereItsTicksAre) {
  const OpLogReader log(golden_recording(1));
  ASSERT_EQ(log.chunks().size(), 3u);
  EXPECT_TRUE(log.chunks()[0].has_notes);
  EXPECT_EQ(log.chunks()[1].first_tick, 0u);
  EXPECT_EQ(log.chunks()[1].ticks, 1000u);
  EXPECT_EQ(log.chunks()[2].first_tick, 1000u);
  EXPECT_EQ(log.chunks()[2].ticks, 40u);
  // Chunks of revision 2 must not be appended to it.
  test::expect_error(ErrorKind::conflict, "revision 1", [&] { log.chain(); });
}

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
  for (uint32_t revision = 1; revision <= ops::newest_revision; ++revision)
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
