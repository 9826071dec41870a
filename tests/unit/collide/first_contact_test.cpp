#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "collide/contact/narrow_phase.hpp"
#include "collide/removal/removal.hpp"
#include "shell/swept_profile.hpp"
#include "shell/tool.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "voxel/bricks.hpp"

namespace ream::test {
namespace {

constexpr uint32_t first_contact_seed = 20317;
constexpr double ball_mm = 6.0;

/// A half-space of bone: what lies behind the plane through `at_mm` that faces `outward`.
voxel::BoneModel half_space(const Vec3& spacing_mm, const Vec3& at_mm, const Vec3& outward) {
  voxel::VoxelGrid grid;
  grid.spacing_mm = spacing_mm;
  for (int k = 0; k < 3; ++k) grid.dims[k] = static_cast<int>(std::ceil(16.0 / spacing_mm[k] / 8.0)) * 8;
  voxel::BoneModel bone = voxel::make_bone(grid);
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const Vec3 centre = (grid.coordinates(i).cast<double>().array() + 0.5) * spacing_mm.array();
    const double depth = outward.dot(at_mm - centre) / spacing_mm.minCoeff();
    bone.coverage[i] = static_cast<uint8_t>(std::clamp(127.5 + 255.0 * depth, 0.0, 255.0));
  }
  return bone;
}

struct Ball {
  Ball(const voxel::BoneModel& in, double spacing_mm)
      : bone(in),
        tool(shell::make_tool("sphere 6")),
        shell(collide::make_contact_shell(shell::make_point_shell(tool, spacing_mm),
                                          bone.grid.spacing_mm.maxCoeff())),
        distance(voxel::brick_distance(bone)),
        cells(bone),
        phase(collide::make_narrow_phase_cpu({shell, bone, distance, cells})) {}

  /// Engaged area, mm2, with the ball's centre there and its cap turned to `facing`.
  double area_mm2(const Vec3& centre_mm, const Vec3& facing) {
    collide::ContactSums sums;
    const QuantisedPose q = quantised(pose(centre_mm, facing));
    const double reach_mm = 2.0 * bone.grid.spacing_mm.maxCoeff();
    EXPECT_TRUE(phase->contact(
        q, collide::broad_phase(cells.bounds_mm(), shell.bounds_mm, dequantised(q), reach_mm), sums));
    return static_cast<double>(sums.cutting.area) / 16.0 * shell.cell_area_mm2;
  }

  void cut(const Vec3& centre_mm, const Vec3& facing) {
    const auto profile = shell::swept_profile(tool.profile, 2.0);
    const auto removal = collide::make_removal_cpu({profile, bone});
    for (uint32_t b = 0; b < bone.grid.brick_count(); ++b) {
      collide::BrickOutcome outcome;
      collide::RemovalSums sums;
      removal->cut(quantised(pose(centre_mm, facing)), {&b, 1}, {&outcome, 1}, sums);
      cells.set(b, voxel::SolidCells::word_of(bone.coverage.data() + bone.grid.brick_base(b)));
    }
  }

  /// The tool's origin is its apex.
  static Pose pose(const Vec3& centre_mm, const Vec3& facing) {
    return {rotation_with_z_along(facing), centre_mm + ball_mm * facing};
  }

  voxel::BoneModel bone;
  shell::Tool tool;
  collide::ContactShell shell;
  voxel::BrickDistance distance;
  voxel::SolidCells cells;
  std::unique_ptr<collide::NarrowPhase> phase;
};

/// How deep a cap of that area is.
double cap_depth_mm(double area_mm2) { return area_mm2 / (2.0 * pi * ball_mm); }

/// Whatever the voxels, and however the face lies in them.
TEST(FirstContact, BeginsWhereTheSurfacesMeetAndGrowsWithDepth) {
  std::mt19937 random(test::seed(first_contact_seed));
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(first_contact_seed));
  for (const Vec3& spacing_mm : {Vec3(0.6, 0.6, 0.6), Vec3(0.2, 0.2, 0.2), Vec3(0.3, 0.3, 0.45)})
    for (int i = 0; i < 12; ++i) {
      const Vec3 outward = i == 0 ? Vec3::UnitZ() : random_direction(random);
      const Vec3 at_mm = Vec3(8, 8, 8) + random_vector(random, 0.5);
      Ball ball(half_space(spacing_mm, at_mm, outward), 0.1);
      const double voxel_mm = spacing_mm.minCoeff();
      // Along an axis of longer edges there may be no voxel in the ramp of the shortest edge.
      const double between_mm = 0.6 * (spacing_mm.maxCoeff() - voxel_mm);
      const auto area_at = [&](double depth_mm) {
        return ball.area_mm2(at_mm + (ball_mm - depth_mm) * outward, -outward);
      };
      double touch_mm = -2.0;
      while (area_at(touch_mm) == 0.0) touch_mm += voxel_mm / 64.0;
      EXPECT_NEAR(touch_mm, 0.0, voxel_mm / 8.0 + between_mm)
          << outward.transpose() << ", " << spacing_mm.transpose();
      for (const double depth_mm : {0.3, 0.6, 1.0})
        EXPECT_NEAR(cap_depth_mm(area_at(depth_mm)), depth_mm, 0.06 + voxel_mm / 8.0 + between_mm)
            << outward.transpose() << ", " << spacing_mm.transpose();
    }
}

/// What has been cut still touches, there and as far back as 1/16 voxel and no farther than an eighth.
TEST(FirstContact, RemovalNeverClearsItsOwnContact) {
  std::mt19937 random(test::seed(first_contact_seed));
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(first_contact_seed));
  for (const double voxel_mm : {0.6, 0.2})
    for (int i = 0; i < 12; ++i) {
      const Vec3 outward = i == 0 ? Vec3::UnitZ() : random_direction(random);
      const Vec3 at_mm = Vec3(8, 8, 8) + random_vector(random, 0.5);
      const Vec3 facing = i < 2 ? Vec3(-outward) : (-outward + random_vector(random, 0.2)).normalized();
      Ball ball(half_space(Vec3::Constant(voxel_mm), at_mm, outward), 0.1);
      const Vec3 centre_mm = at_mm + (ball_mm - 1.0) * outward;
      const double before_mm2 = ball.area_mm2(centre_mm, facing);
      ball.cut(centre_mm, facing);
      EXPECT_GT(ball.area_mm2(centre_mm, facing), 0.85 * before_mm2) << outward.transpose();
      EXPECT_LT(ball.area_mm2(centre_mm + 0.125 * voxel_mm * outward, facing), 0.3 * before_mm2);
      EXPECT_EQ(ball.area_mm2(centre_mm + 0.5 * voxel_mm * outward, facing), 0.0);
    }
}

}  // namespace
}  // namespace ream::test
