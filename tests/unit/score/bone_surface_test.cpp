#include "score/bone_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"

namespace ream::score {
namespace {

/// Bone behind a plane through the grid's middle, `blur_voxels` thick.
voxel::BoneModel half_space(const Vec3& outward, double offset_mm, double voxel_mm, double blur_voxels) {
  voxel::VoxelGrid grid;
  grid.dims = Vec3i(32, 32, 32);
  grid.spacing_mm = Vec3::Constant(voxel_mm);
  voxel::BoneModel bone = voxel::make_bone(grid);
  const Vec3 middle = grid.bounds_mm().centre();
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const double beyond = (grid.centre_mm(grid.coordinates(i)) - middle).dot(outward) - offset_mm;
    const double level = 127.5 - 255.0 * beyond / (voxel_mm * blur_voxels);
    bone.coverage[i] = static_cast<uint8_t>(std::clamp(std::floor(level + 0.5), 0.0, 255.0));
  }
  return bone;
}

/// Mean and greatest error of the surface along lines into the bone, voxels.
struct Errors {
  double mean = 0.0, greatest = 0.0;
};

Errors errors_along_lines(const voxel::BoneModel& bone, const Vec3& outward, double offset_mm,
                          const Vec3& direction, std::mt19937& random) {
  std::uniform_real_distribution<double> aside(-1.0, 1.0);
  const SurfaceFinder finder({bone.grid, bone.coverage.data()});
  const Vec3 middle = bone.grid.bounds_mm().centre();
  Errors e;
  constexpr int lines = 400;
  for (int i = 0; i < lines; ++i) {
    const Vec3 point = middle + Vec3(aside(random), aside(random), aside(random));
    const double truth = (offset_mm - (point - middle).dot(outward)) / direction.dot(outward);
    const auto span = finder.span_in_grid(point, direction);
    const auto found = finder.into_bone(point, direction, span->first, span->second);
    EXPECT_TRUE(found);
    const double error = (found.value_or(1e9) - truth) / bone.grid.min_spacing_mm();
    e.mean += error / lines;
    e.greatest = std::max(e.greatest, std::abs(error));
  }
  return e;
}

TEST(SurfaceFinder, PutsPlanesWhereTheyAre) {
  std::mt19937 random(test::seed(71));
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    const Vec3 outward = Vec3(0.5 * number(random), 0.5 * number(random), 1.0).normalized();
    const double offset_mm = 0.2 * number(random);
    const voxel::BoneModel bone = half_space(outward, offset_mm, 0.2, 1.0);
    const Vec3 direction = -(outward + 0.4 * Vec3(number(random), number(random), 0.0)).normalized();
    const Errors e = errors_along_lines(bone, outward, offset_mm, direction, random);
    EXPECT_LT(std::abs(e.mean), 0.02) << round;
    EXPECT_LT(e.greatest, 0.12) << round;
  }
}

TEST(SurfaceFinder, IsExactAcrossAVoxelAxis) {
  std::mt19937 random(test::seed(72));
  for (const double offset_mm : {0.0, 0.013, 0.05, 0.081, 0.1, 0.137, 0.19}) {
    const voxel::BoneModel bone = half_space(Vec3::UnitZ(), offset_mm, 0.2, 1.0);
    const Errors e = errors_along_lines(bone, Vec3::UnitZ(), offset_mm, -Vec3::UnitZ(), random);
    // A coverage step is 1/255 voxel; the bare level would be up to 0.09 voxels off.
    EXPECT_LT(e.greatest, 0.01) << offset_mm;
  }
}

TEST(SurfaceFinder, AScansBlurIsNoMatter) {
  std::mt19937 random(test::seed(73));
  const Vec3 outward = Vec3(0.2, -0.3, 1.0).normalized();
  const voxel::BoneModel bone = half_space(outward, 0.07, 0.2, 5.0);
  const Errors e = errors_along_lines(bone, outward, 0.07, -outward, random);
  EXPECT_LT(e.greatest, 0.03);
}

TEST(SurfaceFinder, TellsWhereBoneIsNot) {
  voxel::BoneModel bone = half_space(Vec3::UnitZ(), 0.0, 0.2, 1.0);
  const SurfaceFinder finder({bone.grid, bone.coverage.data()});
  const Vec3 middle = bone.grid.bounds_mm().centre();
  EXPECT_FALSE(finder.into_bone(middle, Vec3::UnitZ(), 0.3, 3.0));
  EXPECT_FALSE(finder.span_in_grid(middle + Vec3(50, 0, 0), Vec3::UnitZ()));
  const auto out = finder.out_of_bone(middle - Vec3(0, 0, 2.0), Vec3::UnitZ(), 0.0, 5.0);
  EXPECT_NEAR(out.value(), 2.0, 0.02);
  EXPECT_FALSE(finder.out_of_bone(middle - Vec3(0, 0, 2.0), -Vec3::UnitZ(), 0.0, 0.9));
}

TEST(SurfaceFinder, WorksInAnyGridFrame) {
  std::mt19937 random(test::seed(74));
  voxel::BoneModel bone = half_space(Vec3::UnitZ(), 0.05, 0.2, 1.0);
  const Vec3 middle = bone.grid.bounds_mm().centre();
  const Pose world_from_grid = test::random_pose(random, 40.0);
  bone.grid.world_from_grid = world_from_grid;
  const SurfaceFinder finder({bone.grid, bone.coverage.data()});
  const Vec3 start = world_from_grid.point(middle + Vec3(0, 0, 2.0));
  const Vec3 down = world_from_grid.direction(-Vec3::UnitZ());
  EXPECT_NEAR(finder.into_bone(start, down, 0.0, 5.0).value(), 1.95, 0.003);
}

}  // namespace
}  // namespace ream::score
