#include "record/recorded_bone.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/recorded_cutting.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::record {
namespace {

using test::RecordedCutting;

constexpr uint32_t recorded_bone_seed = 51;
const Vec3i dims(40, 32, 24);

class RecordedBoneTest : public testing::Test {
 protected:
  void expect_truth_at_random_moments(const RecordedCutting& session, int moments) {
    const Recording recording(path_);
    ASSERT_EQ(recording.tick_count(), session.tick);
    RecordedBone bone(recording, session.bone.grid, session.start);
    std::vector<uint8_t> follower = session.start;
    std::mt19937 random(test::seed(recorded_bone_seed));
    for (int i = 0; i < moments; ++i) {
      const auto ticks = static_cast<uint32_t>(random() % (session.tick + 300));
      bone.seek(ticks, [&](const voxel::BrickImage& image) {
        const uint8_t* held = follower.data() + size_t{image.brick} * voxel::brick_voxels;
        EXPECT_NE(std::memcmp(held, image.coverage, voxel::brick_voxels), 0) << "told without need";
        voxel::write_brick(session.bone.grid, follower.data(), image.brick, image.coverage);
      });
      ASSERT_LE(bone.ticks(), ticks);
      ASSERT_GT(bone.ticks() + 2 * ticks_per_chunk, std::min(ticks, session.tick));
      const std::vector<uint8_t>& truth = bone.ticks() == 0 ? session.start : session.after.at(bone.ticks());
      ASSERT_TRUE(follower == truth) << "asked for " << ticks << ", at " << bone.ticks();
      std::vector<uint8_t> whole = session.start;
      bone.write_to(whole);
      ASSERT_TRUE(whole == truth);
      voxel::BoneModel model = session.bone;
      model.coverage = whole;
      ASSERT_EQ(bone.coverage_hash(), model.coverage_hash());
    }
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "recording.ream";
};

TEST_F(RecordedBoneTest, IsTheBoneAtEveryMomentForwardsAndBackwards) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(recorded_bone_seed));
  RecordedCutting session(test::seed(recorded_bone_seed), dims);
  {
    Recorder recorder(create_log_file(path_), session.header(), RecordedCutting::segment(0),
                      session.follower.data());
    session.run(recorder, 2 * chunks_per_key * ticks_per_chunk + 777);
    recorder.finish("finished");
  }
  expect_truth_at_random_moments(session, 150);
}

TEST_F(RecordedBoneTest, HasWholeMomentsThoughImagesComeLate) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(recorded_bone_seed));
  RecordedCutting session(test::seed(recorded_bone_seed), dims);
  {
    Recorder recorder(create_log_file(path_), session.header(), RecordedCutting::segment(0),
                      session.follower.data());
    for (int i = 0; i < 12; ++i) {
      session.run(recorder, 380, 0);  // nothing gets through
      session.run(recorder, 60, 5);
    }
    session.run(recorder, 100, 0);
    session.send_rest(recorder);
    recorder.finish("finished");
  }
  expect_truth_at_random_moments(session, 60);
}

TEST_F(RecordedBoneTest, ImagesThatComeMuchTooLateCostCheckpointsAndNothingElse) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(recorded_bone_seed));
  RecordedCutting session(test::seed(recorded_bone_seed), dims);
  {
    Recorder recorder(create_log_file(path_), session.header(), RecordedCutting::segment(0),
                      session.follower.data());
    session.run(recorder, 5 * max_ticks_per_chunk, 0);
    session.run(recorder, 700);
    recorder.finish("finished");
  }
  const Recording recording(path_, Recording::Trust::checked);
  EXPECT_EQ(recording.tick_count(), session.tick);
  const auto checkpoints = recording.checkpoints();
  EXPECT_EQ(checkpoints.size(), 3u) << "only where the bone is known";
  RecordedBone bone(recording, session.bone.grid, session.start);
  bone.seek(session.tick, [](const voxel::BrickImage&) {});
  EXPECT_EQ(bone.coverage_hash(), session.bone.coverage_hash());
  EXPECT_EQ(checkpoints.back().grid_hash, session.bone.coverage_hash());
}

TEST_F(RecordedBoneTest, WhatIsNotFinishedIsKeptAsFarAsItGoes) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(recorded_bone_seed));
  RecordedCutting session(test::seed(recorded_bone_seed), dims);
  {
    Recorder recorder(create_log_file(path_), session.header(), RecordedCutting::segment(0),
                      session.follower.data());
    session.run(recorder, 610);
  }
  EXPECT_FALSE(Recording(path_).end());
  expect_truth_at_random_moments(session, 30);
}

TEST_F(RecordedBoneTest, GoesOnInAContinuedRecording) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(recorded_bone_seed));
  RecordedCutting session(test::seed(recorded_bone_seed), dims);
  const ops::Header header = session.header();
  {
    Recorder recorder(create_log_file(path_), header, RecordedCutting::segment(0), session.follower.data());
    session.run(recorder, 1234);
    recorder.finish("interrupted");
  }
  {
    const Recording recording(path_);
    RecordedBone bone(recording, session.bone.grid, session.start);
    bone.seek(recording.tick_count(), [](const voxel::BrickImage&) {});
    Recorder recorder(continue_log_file(path_, recording.log().whole_bytes()), recording, bone,
                      RecordedCutting::segment(recording.tick_count()), session.follower.data());
    session.run(recorder, chunks_per_key * ticks_per_chunk + 500);
    recorder.finish("finished");
  }
  const Recording recording(path_);
  EXPECT_EQ(recording.segments().size(), 2u);
  EXPECT_EQ(recording.segments().back().first_tick, 1234u);
  ASSERT_TRUE(recording.end());
  EXPECT_EQ(recording.end()->state, "finished");
  expect_truth_at_random_moments(session, 80);
}

TEST_F(RecordedBoneTest, CheckpointsHoldTheHashOfTheWholeGrid) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(recorded_bone_seed));
  RecordedCutting session(test::seed(recorded_bone_seed), dims);
  {
    Recorder recorder(create_log_file(path_), session.header(), RecordedCutting::segment(0),
                      session.follower.data());
    session.run(recorder, 2600);
    recorder.finish("finished");
  }
  const auto checkpoints = Recording(path_).checkpoints();
  ASSERT_EQ(checkpoints.size(), 11u);
  for (const ops::Checkpoint& checkpoint : checkpoints) {
    voxel::BoneModel model = session.bone;
    model.coverage = session.after.at(checkpoint.tick + 1);
    EXPECT_EQ(checkpoint.grid_hash, model.coverage_hash());
    EXPECT_EQ(checkpoint.session_hash, session.reports[checkpoint.tick].session_hash);
  }
}

}  // namespace
}  // namespace ream::record
