#include "collide/removal/decay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

#include "core/hash.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"

namespace ream::test {
namespace {

struct Scene {
  explicit Scene(int levels_ = 16)
      : bone(slab({64, 64, 64}, 0.25, 8.0, 0.6)),
        points(shell::make_point_shell(shell::make_tool("ellipse 5,3 nipple 1,2"), 0.2)),
        shell(collide::make_decay_shell(points)),
        levels(levels_) {}
  std::unique_ptr<collide::Decay> decay() { return collide::make_decay_cpu({shell, bone, levels}); }

  voxel::BoneModel bone;
  shell::PointShell points;
  collide::DecayShell shell;
  int levels;
};

Pose random_contact(std::mt19937& random) {
  const Mat3 tilt = rotation_about(random_direction(random), 0.5);
  return {tilt * rotation_with_z_along(-Vec3::UnitZ()), Vec3(8, 8, 7.4) + random_vector(random, 1.0)};
}

/// Points of the cutting surface in each voxel, in doubles and straight from the point shell.
std::map<size_t, int> points_in_voxels(const Scene& s, const QuantisedPose& pose) {
  const Pose grid_from_tool = dequantised(pose);
  std::map<size_t, int> count;
  for (const shell::ShellPoint& p : s.points.points) {
    if (p.role != shell::SurfaceRole::cutting) continue;
    const Vec3i at = s.bone.grid.voxel_at(grid_from_tool.point(s.points.surface_point_mm(p)));
    if (s.bone.grid.contains(at)) ++count[s.bone.grid.index(at)];
  }
  return count;
}

TEST(Decay, EveryPointInBoneTakesItsStepFromItsVoxel) {
  const uint32_t seed = test::seed(61);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  Scene s;
  const auto decay = s.decay();
  size_t lowered = 0, apart = 0;
  for (int i = 0; i < 20; ++i) {
    const QuantisedPose pose = quantised(random_contact(random));
    const std::vector<uint8_t> before = s.bone.coverage;
    collide::RemovalSums sums;
    ASSERT_TRUE(decay->apply(pose, sums));
    std::map<size_t, int> points = points_in_voxels(s, pose);
    for (size_t v = 0; v < before.size(); ++v) {
      if (before[v] == s.bone.coverage[v] && !points.contains(v)) continue;
      const int expected = std::max(0, before[v] - 16 * points[v]);
      lowered += expected != before[v];
      // Points within rounding of a voxel's border may fall either way.
      apart += expected != s.bone.coverage[v];
      if (s.bone.coverage[v] != 0) {
        ASSERT_EQ((before[v] - s.bone.coverage[v]) % 16, 0);
      }
    }
  }
  EXPECT_GT(lowered, 5000u);
  EXPECT_LT(apart, lowered / 200) << "seed " << seed;
}

TEST(Decay, SumsHashAndBricksAreThoseOfTheChangedVoxels) {
  const uint32_t seed = test::seed(62);
  std::mt19937 random(seed);
  Scene s(40);
  const auto density = s.bone.density;
  const auto decay = s.decay();
  for (int i = 0; i < 30; ++i) {
    const std::vector<uint8_t> before = s.bone.coverage;
    collide::RemovalSums sums;
    ASSERT_TRUE(decay->apply(quantised(random_contact(random)), sums));
    int64_t removed = 0;
    uint64_t hash = 0;
    std::set<uint32_t> bricks;
    for (size_t v = 0; v < before.size(); ++v) {
      if (before[v] == s.bone.coverage[v]) continue;
      ASSERT_LT(s.bone.coverage[v], before[v]);
      removed += before[v] - s.bone.coverage[v];
      hash += mix64(v * 256 + s.bone.coverage[v]) - mix64(v * 256 + before[v]);
      bricks.insert(static_cast<uint32_t>(v / voxel::brick_voxels));
    }
    const auto changed = decay->changed_bricks();
    EXPECT_EQ(std::set<uint32_t>(changed.begin(), changed.end()), bricks) << "seed " << seed;
    EXPECT_EQ(changed.size(), bricks.size());
    EXPECT_EQ(sums.changed_bricks, bricks.size());
    EXPECT_EQ(sums.coverage_removed[0], removed);
    EXPECT_EQ(sums.change_hash, hash);
  }
  EXPECT_EQ(s.bone.density, density);
}

TEST(Decay, TheOrderOfThePointsCannotMatter) {
  const uint32_t seed = test::seed(63);
  std::mt19937 random(seed);
  Scene a(100), b(100);
  std::vector<uint32_t> order(b.shell.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  collide::DecayShell shuffled = b.shell;
  for (size_t i = 0; i < order.size(); ++i) {
    shuffled.x_mm[i] = b.shell.x_mm[order[i]];
    shuffled.y_mm[i] = b.shell.y_mm[order[i]];
    shuffled.z_mm[i] = b.shell.z_mm[order[i]];
  }
  for (auto& run : shuffled.runs) run.radius_mm = 100.0f;
  b.shell = shuffled;
  const auto decay_a = a.decay(), decay_b = b.decay();
  for (int i = 0; i < 20; ++i) {
    const QuantisedPose pose = quantised(random_contact(random));
    collide::RemovalSums sums_a, sums_b;
    ASSERT_TRUE(decay_a->apply(pose, sums_a));
    ASSERT_TRUE(decay_b->apply(pose, sums_b));
    ASSERT_EQ(sums_a, sums_b) << "seed " << seed;
  }
  EXPECT_EQ(a.bone.coverage, b.bone.coverage);
}

TEST(Decay, AVoxelUnderOnePointIsGoneWhenItsStepsAreUsedUp) {
  Scene s;
  const auto decay = s.decay();
  const QuantisedPose pose = quantised({rotation_with_z_along(-Vec3::UnitZ()), Vec3(8.03, 8.04, 7.3)});
  const auto points = points_in_voxels(s, pose);
  collide::RemovalSums sums;
  for (int tick = 0; tick < 16; ++tick) ASSERT_TRUE(decay->apply(pose, sums));
  size_t left = 0;
  for (const auto& [voxel, count] : points) left += s.bone.coverage[voxel] != 0;
  EXPECT_LE(left, points.size() / 100) << "255 / 16 steps";
  ASSERT_TRUE(decay->apply(pose, sums));
  EXPECT_EQ(sums.changed_bricks, 0u);
  EXPECT_EQ(sums.change_hash, 0u);
}

}  // namespace
}  // namespace ream::test
