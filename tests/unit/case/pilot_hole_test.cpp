#include <gtest/gtest.h>

#include <cmath>

#include "case/case.hpp"
#include "core/units.hpp"

namespace ream::case_ {
namespace {

/// A block 20 mm long on every side but the half space x < 4 mm (grid frame), turned in the world.
voxel::BoneModel half_block() {
  voxel::VoxelGrid grid;
  grid.dims = Vec3i::Constant(80);
  grid.spacing_mm = Vec3::Constant(0.25);
  grid.world_from_grid.rotation = rotation_from_small_vector({0.2, 0.4, -0.3});
  grid.world_from_grid.translation_mm = {100, -50, 30};
  voxel::BoneModel bone = voxel::make_bone(grid);
  for (size_t i = 0; i < bone.coverage.size(); ++i)
    bone.coverage[i] = grid.coordinates(i).x() >= 16 ? 255 : 0;
  return bone;
}

double volume_mm3(const voxel::BoneModel& bone) {
  double sum = 0;
  for (const uint8_t c : bone.coverage) sum += c / 255.0;
  return sum * bone.grid.voxel_volume_mm3();
}

Plan oblique_plan(const voxel::BoneModel& bone) {
  Plan plan;
  plan.entry_mm = bone.grid.world_from_grid.point({4, 10, 10});
  plan.axis_direction = bone.grid.world_from_grid.direction(Vec3(1, 0.1, -0.2).normalized());
  plan.pilot_hole = PilotHole{6.2, 10.0};
  return plan;
}

TEST(PilotHole, RemovesACylinderOnce) {
  voxel::BoneModel bone = half_block();
  const Plan plan = oblique_plan(bone);
  const double before = volume_mm3(bone);
  cut_pilot_hole(bone, plan);
  // The face is cut obliquely through the centre of the cylinder's cross-section, which leaves the volume.
  EXPECT_NEAR(before - volume_mm3(bone), pi * 3.1 * 3.1 * 10.0, 0.01 * pi * 3.1 * 3.1 * 10.0);
  const auto once = bone.coverage;
  cut_pilot_hole(bone, plan);
  EXPECT_EQ(bone.coverage, once);
}

TEST(PilotHole, TouchesNothingElse) {
  const voxel::BoneModel before = half_block();
  voxel::BoneModel bone = before;
  const Plan plan = oblique_plan(bone);
  cut_pilot_hole(bone, plan);
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const Vec3 p =
        bone.grid.world_from_grid.point(bone.grid.centre_mm(bone.grid.coordinates(i))) - plan.entry_mm;
    const double along = p.dot(plan.axis_direction), across = (p - along * plan.axis_direction).norm();
    if (across > 3.1 + 0.126 || along > 10.0 + 0.126) {
      ASSERT_EQ(bone.coverage[i], before.coverage[i]);
    } else if (across < 3.1 - 0.126 && along < 10.0 - 0.126 && along > -2.8) {
      ASSERT_EQ(bone.coverage[i], 0);
    }
  }
}

TEST(PilotHole, NoHoleOrAHoleElsewhereChangesNothing) {
  voxel::BoneModel bone = half_block();
  const auto before = bone.coverage;
  Plan plan = oblique_plan(bone);
  plan.pilot_hole.reset();
  cut_pilot_hole(bone, plan);
  plan = oblique_plan(bone);
  plan.entry_mm += Vec3(1000, 0, 0);
  cut_pilot_hole(bone, plan);
  EXPECT_EQ(bone.coverage, before);
}

TEST(SurfaceAlong, FindsTheFaceFromEitherSideOfIt) {
  const voxel::BoneModel bone = half_block();
  const Vec3 direction = bone.grid.world_from_grid.direction(Vec3(1, 0.1, -0.2).normalized());
  const Vec3 face = bone.grid.world_from_grid.point({4, 10, 10});
  for (const double s : {-30.0, -1.0, 0.0, 5.0}) {
    const auto hit = surface_along(bone, face + s * direction, direction);
    ASSERT_TRUE(hit);
    EXPECT_LT((*hit - face).norm(), 1e-3);
  }
}

TEST(SurfaceAlong, MissIsEmpty) {
  const voxel::BoneModel bone = half_block();
  const auto& pose = bone.grid.world_from_grid;
  EXPECT_FALSE(surface_along(bone, pose.point({-50, 0, 0}), pose.direction(Vec3::UnitY())));
  EXPECT_FALSE(surface_along(bone, pose.point({2, 10, 10}), pose.direction(Vec3::UnitY())));
}

}  // namespace
}  // namespace ream::case_
