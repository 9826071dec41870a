#include "collide/removal/removal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "collide/removal/removal_schedule.hpp"
#include "core/hash.hpp"
#include "support/cut_bricks.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"

namespace ream::test {
namespace {

struct RemovalScene {
  RemovalScene()
      : bone(slab({64, 64, 64}, 0.25, 8.0, 0.6)),
        tool(shell::make_tool("ellipse 5,3")),
        profile(shell::swept_profile(tool.profile, collide::RemovalSchedule::needed_margin_mm(bone.grid))),
        removal(collide::make_removal_cpu({profile, bone})) {}

  collide::RemovalSums cut(const QuantisedPose& pose, const std::vector<uint32_t>& bricks) {
    return cut_bricks(*removal, pose, bricks).sums;
  }
  std::vector<uint32_t> all_bricks() const {
    std::vector<uint32_t> bricks(bone.grid.brick_count());
    std::iota(bricks.begin(), bricks.end(), 0u);
    return bricks;
  }

  voxel::BoneModel bone;
  shell::Tool tool;
  shell::SweptProfile profile;
  std::unique_ptr<collide::Removal> removal;
};

Pose at(double x, double y, double z) { return {rotation_with_z_along(-Vec3::UnitZ()), Vec3(x, y, z)}; }

TEST(Removal, EveryVoxelKeepsWhatItsDistanceToTheSweptBodySays) {
  RemovalScene s;
  const voxel::BoneModel before = s.bone;
  const Pose pose = at(8.1, 7.9, 6.3);
  s.cut(quantised(pose), s.all_bricks());
  const Pose tool_from_grid = pose.inverse();
  for (size_t i = 0; i < before.coverage.size(); ++i) {
    const Vec3 p = tool_from_grid.point(s.bone.grid.centre_mm(s.bone.grid.coordinates(i)));
    const double distance = shell::swept_distance_mm(s.tool.profile, std::hypot(p.x(), p.y()), p.z());
    const double kept = std::clamp(128.0 + 255.0 * distance / 0.25, 0.0, 255.0);
    const double expected = std::min<double>(before.coverage[i], kept);
    ASSERT_NEAR(s.bone.coverage[i], expected, 7.0) << "voxel " << i << " distance " << distance;
  }
}

TEST(Removal, IsIdempotentAndOrderFree) {
  const uint32_t seed = test::seed(5);
  std::mt19937 random(seed);
  std::vector<QuantisedPose> poses;
  for (int i = 0; i < 12; ++i)
    poses.push_back(quantised(Pose{rotation_about(random_direction(random), 0.3), Vec3::Zero()} *
                              at(8 + random_vector(random, 3).x(), 8, 6.5)));
  RemovalScene forwards, backwards;
  std::vector<uint32_t> bricks = forwards.all_bricks();
  for (const auto& pose : poses) forwards.cut(pose, bricks);
  std::shuffle(bricks.begin(), bricks.end(), random);
  for (auto it = poses.rbegin(); it != poses.rend(); ++it) backwards.cut(*it, bricks);
  EXPECT_EQ(forwards.bone.coverage, backwards.bone.coverage) << "seed " << seed;
  const collide::RemovalSums again = forwards.cut(poses.front(), bricks);
  EXPECT_EQ(again.changed_bricks, 0u);
  EXPECT_EQ(again.change_hash, 0u);
}

TEST(Removal, SumsAndHashAreThoseOfTheChangedVoxels) {
  RemovalScene s;
  const auto before = s.bone.coverage;
  const collide::RemovalSums sums = s.cut(quantised(at(8, 8, 6)), s.all_bricks());
  int64_t removed = 0;
  uint64_t hash = 0;
  for (size_t i = 0; i < before.size(); ++i)
    if (s.bone.coverage[i] != before[i]) {
      removed += before[i] - s.bone.coverage[i];
      hash += mix64(i * 256 + s.bone.coverage[i]);
    }
  EXPECT_GT(removed, 0);
  EXPECT_EQ(sums.coverage_removed[0], removed);
  EXPECT_EQ(sums.coverage_removed[1], 0);
  EXPECT_EQ(sums.change_hash, hash);
}

TEST(RemovalSchedule, AScheduledPlungeEndsWithinAThirtySecondVoxelOfCuttingEverything) {
  RemovalScene scheduled, full;
  collide::RemovalSchedule schedule(scheduled.profile, scheduled.bone);
  size_t visited = 0, ticks = 0;
  for (double z = 8.3; z > 5.5; z -= 0.002, ++ticks) {
    const QuantisedPose pose = quantised(at(8.0 + 0.1 * std::sin(40 * z), 8.0, z));
    const auto due = schedule.due(pose);
    const CutAnswer answer = cut_bricks(*scheduled.removal, pose, due);
    for (size_t i = 0; i < due.size(); ++i) schedule.cut_done(i, answer.outcomes[i]);
    visited += due.size();
    full.cut(pose, full.all_bricks());
  }
  for (size_t i = 0; i < full.bone.coverage.size(); ++i) {
    ASSERT_GE(scheduled.bone.coverage[i], full.bone.coverage[i]) << "voxel " << i;
    ASSERT_LE(scheduled.bone.coverage[i] - full.bone.coverage[i], 9) << "voxel " << i;
  }
  EXPECT_LT(visited, ticks * scheduled.bone.grid.brick_count() / 20);
}

}  // namespace
}  // namespace ream::test
