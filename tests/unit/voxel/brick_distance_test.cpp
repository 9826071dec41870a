#include "voxel/brick_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "support/random_bone.hpp"
#include "support/seed.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::voxel {
namespace {

constexpr uint32_t brick_distance_seed = 20267;

/// Chebyshev distance from a point to the nearest box of a solid voxel, voxel units.
float true_distance(const BoneModel& bone, const Vec3f& p) {
  float nearest = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    if (bone.coverage[i] < solid_coverage) continue;
    const Vec3f low = bone.grid.coordinates(i).cast<float>();
    const Vec3f gap = (low - p).cwiseMax(p - low - Vec3f::Ones()).cwiseMax(0.0f);
    nearest = std::min(nearest, gap.maxCoeff());
  }
  return nearest;
}

TEST(BrickDistance, IsTheChebyshevDistanceBetweenBricks) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(brick_distance_seed));
  std::mt19937 random(test::seed(brick_distance_seed));
  for (int round = 0; round < 20; ++round) {
    const BoneModel bone = test::random_bone(random, {56, 40, 24}, 5e-5 * (round + 1));
    const BrickDistance field = brick_distance(bone);
    ASSERT_GE(field.bricks.size(), bone.grid.brick_count());
    ASSERT_EQ(field.bricks.size() % 4, 0u);
    std::vector<Vec3i> with_bone;
    for (size_t i = 0; i < bone.coverage.size(); ++i)
      if (bone.coverage[i] > 0) with_bone.push_back(bone.grid.coordinates(i) / brick_edge);
    for (uint32_t b = 0; b < bone.grid.brick_count(); ++b) {
      int expected = 255;
      for (const Vec3i& other : with_bone)
        expected = std::min(expected, (bone.grid.brick_coordinates(b) - other).cwiseAbs().maxCoeff());
      ASSERT_EQ(field.bricks[b], expected) << "brick " << b << " round " << round;
    }
  }
}

TEST(BrickDistance, NeverExceedsTheTrueDistance) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(brick_distance_seed));
  std::mt19937 random(test::seed(brick_distance_seed));
  std::uniform_real_distribution<float> place(-30.0f, 90.0f);
  for (int round = 0; round < 10; ++round) {
    const BoneModel bone = test::random_bone(random, {56, 40, 24}, 2e-4);
    const BrickDistance field = brick_distance(bone);
    for (int i = 0; i < 500; ++i) {
      const Vec3f p(place(random), place(random), place(random));
      const float bound = field.lower_bound_voxels(p.x(), p.y(), p.z());
      ASSERT_LE(bound, true_distance(bone, p)) << p.transpose();
      ASSERT_GE(bound, 0.0f);
    }
  }
}

TEST(BrickDistance, IsUsefulFarFromBone) {
  BoneModel bone = make_bone(test::grid_of({256, 64, 64}));
  bone.coverage[0] = 1;
  const BrickDistance field = brick_distance(bone);
  // 20 bricks away: the bound may fall short of the truth by two bricks, not more.
  EXPECT_GE(field.lower_bound_voxels(161.0f, 5.0f, 5.0f), 161.0f - 2.0f * brick_edge);
  EXPECT_GE(field.lower_bound_voxels(-100.0f, 5.0f, 5.0f), 100.0f);
}

TEST(BrickDistance, StaysABoundWhileBoneIsRemoved) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(brick_distance_seed));
  std::mt19937 random(test::seed(brick_distance_seed));
  BoneModel bone = test::random_bone(random, {32, 32, 32}, 0.002);
  const BrickDistance field = brick_distance(bone);
  std::uniform_real_distribution<float> place(-8.0f, 40.0f);
  for (size_t i = 0; i < bone.coverage.size(); i += 2) bone.coverage[i] = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3f p(place(random), place(random), place(random));
    ASSERT_LE(field.lower_bound_voxels(p.x(), p.y(), p.z()), true_distance(bone, p));
  }
}

TEST(BrickDistance, OfAnEmptyBoneIsFarEverywhere) {
  const BrickDistance field = brick_distance(make_bone(test::grid_of({16, 16, 16})));
  EXPECT_TRUE(std::all_of(field.bricks.begin(), field.bricks.end(), [](uint8_t d) { return d == 255; }));
  EXPECT_GT(field.lower_bound_voxels(8.0f, 8.0f, 8.0f), 1000.0f);
}

}  // namespace
}  // namespace ream::voxel
