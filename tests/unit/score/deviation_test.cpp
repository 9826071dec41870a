#include "score/deviation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shell/parametric_profile.hpp"
#include "support/expect_error.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"
#include "surface/block_mesh.hpp"

namespace ream::score {
namespace {

constexpr double radius_mm = 9.0, outer_mm = 6.0, back_mm = 20.0;
constexpr double half_step_mm = 0.5 * deviation_step_mm + 1e-4;  // and the rounding of vertices to floats

/// Distance to a spherical cap of `outer_mm` and the cylinder behind it, by their formulas; tool frame with
/// the apex at the origin and the feed along z.
double true_distance_mm(const Vec3& p) {
  const double r = std::hypot(p.x(), p.y()), from_centre = std::hypot(r, p.z() + radius_mm);
  const double rim_z = std::sqrt(radius_mm * radius_mm - outer_mm * outer_mm) - radius_mm;
  const double to_rim = std::hypot(r - outer_mm, p.z() - rim_z);
  // The cap is nearest where the ray from its centre meets it, the wall where the point lies behind the rim.
  const bool over_cap = p.z() + radius_mm > 0.0 && r * (rim_z + radius_mm) <= outer_mm * (p.z() + radius_mm);
  const double to_cap = over_cap ? std::abs(from_centre - radius_mm) : to_rim;
  const double to_wall = p.z() <= rim_z ? std::abs(r - outer_mm) : to_rim;
  const double front_z = r < radius_mm ? std::sqrt(radius_mm * radius_mm - r * r) - radius_mm : -1e9;
  const bool inside = r < outer_mm && p.z() < front_z;
  return (inside ? -1.0 : 1.0) * std::min(to_cap, to_wall);
}

SweptFront front() { return {shell::parametric_profile("sphere 9,6"), back_mm}; }

TEST(SweptFront, IsACapWithAWallBehindIt) {
  const SweptFront swept = front();
  EXPECT_NEAR(swept.outer_mm(), outer_mm, 1e-9);
  std::mt19937 random(test::seed(81));
  std::uniform_real_distribution<double> across(-9.0, 9.0), along(-9.0, 6.0);
  for (int round = 0; round < 5000; ++round) {
    const Vec3 p(across(random), across(random), along(random));
    EXPECT_NEAR(swept.distance_mm(p), true_distance_mm(p), 2e-4) << "seed 81, " << p.transpose();
  }
}

TEST(SweptFront, ContinuesFlatWhereANippleStands) {
  const SweptFront swept(shell::parametric_profile("sphere 9,6 nipple 2,5"), back_mm);
  const double flat_z = std::sqrt(81.0 - 4.0) - 9.0;
  EXPECT_NEAR(swept.distance_mm(Vec3(0.0, 0.0, flat_z + 1.0)), 1.0, 1e-3);
  EXPECT_NEAR(swept.distance_mm(Vec3(1.0, 0.5, flat_z - 0.3)), -0.3, 1e-3);
  shell::ToolProfile smooth = shell::parametric_profile("sphere 9,6");
  for (auto& role : smooth.roles) role = shell::SurfaceRole::smooth;
  test::expect_error(ErrorKind::invalid_input, "no cutting surface", [&] { SweptFront(smooth, back_mm); });
}

TEST(DeviationCode, RoundsToHalfAStepAndSaturates) {
  for (double mm = -deviation_range_mm; mm <= deviation_range_mm; mm += 0.0007)
    EXPECT_NEAR(deviation_mm(deviation_code(mm)), mm, 0.5 * deviation_step_mm + 1e-12);
  EXPECT_EQ(deviation_code(4.5), 127);
  EXPECT_EQ(deviation_code(-400.0), -127) << "-128 says that nothing is known";
  EXPECT_EQ(deviation_code(0.0), 0);
}

/// A slab that was reamed beside the plan.
class ReamedSlab : public testing::Test {
 protected:
  static constexpr double surface_mm = 9.0;

  ReamedSlab() {
    voxel::BoneModel bone = test::slab(Vec3i(96, 96, 64), 0.2, surface_mm, 1.0);
    grid_ = bone.grid;
    native_ = bone.coverage;
    start_ = native_;
    native_surface_ = surface::whole_surface(grid_, native_.data());
  }

  /// A tool straight down into the slab, turned a little, its apex so far beside the middle and below the
  /// surface.
  Pose grid_from_tool(double beside_mm, double depth_mm, double tilt_rad) const {
    const Mat3 down = rotation_with_z_along(-Vec3::UnitZ());
    const Mat3 tilt = rotation_from_small_vector(Vec3(tilt_rad, 0.0, 0.0));
    return {tilt * down, Vec3(9.6 + beside_mm, 9.6, surface_mm - depth_mm)};
  }

  void drill(double hole_radius_mm, double hole_depth_mm) {
    cut(start_, [&](const Vec3& p) {
      return std::max(std::hypot(p.x() - 9.6, p.y() - 9.6) - hole_radius_mm,
                      surface_mm - hole_depth_mm - p.z());
    });
  }

  void ream(const Pose& grid_from_tool) {
    left_ = start_;
    const Pose tool_from_grid = grid_from_tool.inverse();
    cut(left_, [&](const Vec3& p) { return true_distance_mm(tool_from_grid.point(p)); });
  }

  template <typename Distance>
  void cut(std::vector<uint8_t>& coverage, const Distance& distance) {
    for (size_t i = 0; i < coverage.size(); ++i) {
      const double d = distance(grid_.centre_mm(grid_.coordinates(i))) / grid_.spacing_mm.x();
      coverage[i] = std::min(coverage[i], static_cast<uint8_t>(std::clamp(128.0 + 255.0 * d, 0.0, 255.0)));
    }
  }

  BoneStates states() const { return {grid_, native_.data(), start_.data(), left_.data()}; }

  voxel::VoxelGrid grid_;
  std::vector<uint8_t> native_, start_, left_;
  TriangleMesh native_surface_;
};

TEST_F(ReamedSlab, LiesBeyondThePlanByTheTrueDistance) {
  const Pose planned = grid_from_tool(0.0, 2.0, 0.0);
  ream(grid_from_tool(0.7, 2.4, 0.12));
  const TriangleMesh surface = surface::whole_surface(grid_, left_.data());
  const TriangleTree native(native_surface_);
  const auto codes = deviation_from_plan(surface.vertices_mm, states(), {front(), planned.inverse()}, native);
  size_t proud = 0, deep = 0, unknown = 0;
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 p = surface.vertices_mm[i].cast<double>();
    const double beyond = true_distance_mm(planned.inverse().point(p));
    const double below = surface_mm - p.z();
    if (beyond <= 0.0) {
      ASSERT_NE(codes[i], deviation_unknown) << p.transpose();
      EXPECT_NEAR(deviation_mm(codes[i]), beyond, half_step_mm) << p.transpose();
      ++proud;
    } else if (codes[i] == deviation_unknown) {
      EXPECT_LT(std::min({below, p.x(), p.y(), p.z(), 19.2 - p.x(), 19.2 - p.y()}), 0.01)
          << "cut, but not compared: " << p.transpose();
      ++unknown;
    } else {
      EXPECT_NEAR(deviation_mm(codes[i]), std::min(beyond, std::abs(below)), half_step_mm) << p.transpose();
      ++deep;
    }
  }
  EXPECT_GT(proud, 300u);
  EXPECT_GT(deep, 1000u);
  EXPECT_GT(unknown, 10000u);
}

TEST_F(ReamedSlab, ReamedAsPlannedDeviatesByNoMoreThanTheSurfacesOwnError) {
  const Pose planned = grid_from_tool(0.0, 2.0, 0.1);
  ream(planned);
  const TriangleMesh surface = surface::whole_surface(grid_, left_.data());
  const auto codes = deviation_from_plan(surface.vertices_mm, states(), {front(), planned.inverse()},
                                         TriangleTree(native_surface_));
  size_t compared = 0;
  for (const int8_t code : codes) {
    if (code == deviation_unknown) continue;
    EXPECT_LE(std::abs(deviation_mm(code)), 0.5 * grid_.spacing_mm.x());
    ++compared;
  }
  EXPECT_GT(compared, 2000u);
}

TEST_F(ReamedSlab, WhatIsFarTooDeepSaturates) {
  ream(grid_from_tool(0.0, 7.5, 0.0));
  const TriangleMesh surface = surface::whole_surface(grid_, left_.data());
  const auto codes =
      deviation_from_plan(surface.vertices_mm, states(), {front(), grid_from_tool(0.0, 2.0, 0.0).inverse()},
                          TriangleTree(native_surface_));
  EXPECT_EQ(*std::max_element(codes.begin(), codes.end()), 127);
}

TEST_F(ReamedSlab, ThePilotHoleIsNotCompared) {
  drill(1.5, 6.0);
  ream(grid_from_tool(0.0, 2.0, 0.0));
  const TriangleMesh surface = surface::whole_surface(grid_, left_.data());
  const PlacedFront planned{front(), grid_from_tool(0.0, 2.0, 0.0).inverse()};
  const auto from_plan =
      deviation_from_plan(surface.vertices_mm, states(), planned, TriangleTree(native_surface_));
  const auto from_implant = deviation_from_implant(surface.vertices_mm, states(), planned);
  size_t in_hole = 0;
  for (size_t i = 0; i < from_plan.size(); ++i) {
    const Vec3 p = surface.vertices_mm[i].cast<double>();
    if (std::hypot(p.x() - 9.6, p.y() - 9.6) > 1.7 || p.z() > surface_mm - 2.3 || p.z() < 1.0) continue;
    EXPECT_EQ(from_plan[i], deviation_unknown) << p.transpose();
    EXPECT_EQ(from_implant[i], deviation_unknown) << p.transpose();
    ++in_hole;
  }
  EXPECT_GT(in_hole, 200u);
}

TEST_F(ReamedSlab, LiesBehindTheImplantByTheTrueGap) {
  ream(grid_from_tool(0.0, 2.0, 0.0));
  const TriangleMesh surface = surface::whole_surface(grid_, left_.data());
  // The implant sits a little proud and tilted: a wedge of air on one side, bone into it on the other.
  const Pose implant = grid_from_tool(0.3, 1.8, -0.08);
  const auto codes = deviation_from_implant(surface.vertices_mm, states(), {front(), implant.inverse()});
  size_t gaps = 0, sunk = 0;
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 p = implant.inverse().point(surface.vertices_mm[i].cast<double>());
    const double gap = true_distance_mm(p);
    if (std::hypot(p.x(), p.y()) > outer_mm + 1e-4 || std::abs(gap) > far_from_implant_mm + 1e-4) {
      EXPECT_EQ(codes[i], deviation_unknown) << p.transpose();
    } else if (std::hypot(p.x(), p.y()) < outer_mm - 1e-4 && std::abs(gap) < far_from_implant_mm - 1e-4) {
      ASSERT_NE(codes[i], deviation_unknown) << p.transpose();
      EXPECT_NEAR(deviation_mm(codes[i]), std::clamp(gap, -deviation_range_mm, deviation_range_mm),
                  half_step_mm);
      ++(gap > 0.0 ? gaps : sunk);
    }
  }
  EXPECT_GT(gaps, 1000u);
  EXPECT_GT(sunk, 100u);
}

}  // namespace
}  // namespace ream::score
