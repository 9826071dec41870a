#include "shell/point_shell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "core/units.hpp"
#include "geometry/morton.hpp"
#include "shell/meridian.hpp"
#include "support/expect_error.hpp"
#include "support/shared_data.hpp"

namespace ream::shell {
namespace {

Vec3 normal_of(const ShellPoint& p) { return p.normal.cast<double>(); }

double radius_of(const Vec3& p) { return std::hypot(p.x(), p.y()); }

double area_mm2(const PointShell& shell, SurfaceRole role) {
  double area = 0.0;
  for (const ShellPoint& p : shell.points)
    if (p.role == role) area += p.area_weight / 16.0 * shell.spacing_mm * shell.spacing_mm;
  return area;
}

/// Of all frusta with that role.
double true_area_mm2(const ToolProfile& profile, SurfaceRole role) {
  double area = 0.0;
  for (size_t i = 0; i < profile.roles.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    if (profile.roles[i] == role)
      area += pi * (a.radius_mm + b.radius_mm) * std::hypot(a.radius_mm - b.radius_mm, a.z_mm - b.z_mm);
  }
  return area;
}

TEST(Morton, RoundTripsAndKeepsOrder) {
  for (uint32_t c = 0; c < 1024; ++c) {
    EXPECT_EQ(gather_bits(spread_bits(c)), c);
    EXPECT_EQ(morton_code(c, 0, 0), spread_bits(c));
  }
  for (uint32_t u = 0; u < 1024; u += 31)
    for (uint32_t v = 0; v < 1024; v += 33)
      for (uint32_t w = 0; w < 1024; ++w) {
        const uint64_t code = morton_code(u, v, w);
        ASSERT_EQ(gather_bits(code), u);
        ASSERT_EQ(gather_bits(code >> 1), v);
        ASSERT_EQ(gather_bits(code >> 2), w);
        ASSERT_EQ(code >> 9, morton_code(u / 8, v / 8, w / 8)) << "a block of 8^3 cells is a run of codes";
      }
}

TEST(PointShell, SphereCapHasItsAnalyticArea) {
  // Cap of height h: 2 pi R h.
  const double height = 20.0 - std::sqrt(400.0 - 18.25 * 18.25);
  const PointShell shell = make_point_shell(make_tool("sphere 20"), 0.1);
  EXPECT_NEAR(area_mm2(shell, SurfaceRole::cutting) / (2.0 * pi * 20.0 * height), 1.0, 0.01);
}

class PointShellOf : public testing::TestWithParam<std::pair<const char*, double>> {
 protected:
  Tool tool = make_tool(GetParam().first);
  PointShell shell = make_point_shell(tool, GetParam().second);
};

TEST_P(PointShellOf, AreaOfEachRoleIsThatOfTheProfile) {
  for (const SurfaceRole role : {SurfaceRole::cutting, SurfaceRole::guiding, SurfaceRole::smooth}) {
    const double truth = true_area_mm2(tool.profile, role);
    EXPECT_NEAR(area_mm2(shell, role), truth, 0.02 * truth) << static_cast<int>(role);
  }
}

TEST_P(PointShellOf, PointsLieOnTheSurfaceWithOutwardUnitNormals) {
  for (const ShellPoint& p : shell.points) {
    const Vec3 at = shell.surface_point_mm(p), normal = normal_of(p);
    const double off = nearest_on_profile(tool.profile, radius_of(at), at.z()).signed_distance_mm;
    ASSERT_LT(std::abs(off), 0.01 * shell.spacing_mm) << at.transpose();
    ASSERT_NEAR(normal.norm(), 1.0, 0.01);
    ASSERT_LE(std::abs(p.surface_offset_mm), 0.52 * std::sqrt(3.0) * shell.spacing_mm);
    // Half of it at corners, where the normal may run along a face.
    const double step = 0.3 * shell.spacing_mm;
    const Vec3 outside = at + step * normal, inside = at - step * normal;
    const double ahead = nearest_on_profile(tool.profile, radius_of(outside), outside.z()).signed_distance_mm;
    const double behind = nearest_on_profile(tool.profile, radius_of(inside), inside.z()).signed_distance_mm;
    ASSERT_GT(ahead, -0.01 * shell.spacing_mm);
    ASSERT_LT(behind, 0.01 * shell.spacing_mm);
    ASSERT_GT(ahead - behind, 0.9 * step);
    ASSERT_NEAR(p.area_weight, 16.0 / normal.cwiseAbs().maxCoeff(), 0.7);
  }
}

TEST_P(PointShellOf, BlocksCoverAllPointsOnceAndSpheresBound) {
  uint32_t next = 0;
  std::set<uint64_t> seen;
  for (const ShellBlock& block : shell.blocks) {
    ASSERT_EQ(block.first, next);
    ASSERT_GT(block.count, 0u);
    next += block.count;
    ASSERT_TRUE(seen.insert(shell.points[block.first].morton >> 9).second);
    for (uint32_t i = block.first; i < next; ++i) {
      ASSERT_EQ(shell.points[i].morton >> 9, shell.points[block.first].morton >> 9);
      ASSERT_TRUE(i == 0 || shell.points[i - 1].morton < shell.points[i].morton);
      const Vec3 at = shell.surface_point_mm(shell.points[i]);
      ASSERT_LE((at - block.centre_mm.cast<double>()).norm(), block.radius_mm + 1e-9);
    }
    ASSERT_LE(block.radius_mm, (4.0 * std::sqrt(3.0) + 1.0) * shell.spacing_mm);
  }
  EXPECT_EQ(next, shell.points.size());
}

TEST_P(PointShellOf, LeavesNoHolesInFrontOfTheTool) {
  // Six-separable: every line along z within the tool's outline meets the front and the back.
  std::set<std::pair<uint32_t, uint32_t>> front;
  for (const ShellPoint& p : shell.points)
    if (p.role != SurfaceRole::smooth) front.insert({gather_bits(p.morton), gather_bits(p.morton >> 1)});
  const double reach = tool.profile.max_radius_mm() - shell.spacing_mm;
  for (int u = 0; u < shell.dims.x(); ++u)
    for (int v = 0; v < shell.dims.y(); ++v) {
      const Vec3 centre = shell.origin_mm + shell.spacing_mm * Vec3(u + 0.5, v + 0.5, 0.0);
      if (radius_of(centre) > reach) continue;
      ASSERT_TRUE(front.contains({static_cast<uint32_t>(u), static_cast<uint32_t>(v)})) << centre.transpose();
    }
}

INSTANTIATE_TEST_SUITE_P(Tools, PointShellOf,
                         testing::Values(std::pair{"sphere 20", 0.25}, std::pair{"sphere 3", 0.07},
                                         std::pair{"ellipse 18.25,9 nipple 3,8", 0.2},
                                         std::pair{"thesis", 0.1},
                                         std::pair{"ellipse 12,6 nipple 2.5,6.05 back 3.15", 0.1}));

TEST(PointShell, BenchToolHasThePointsOfTheThesis) {
  const PointShell shell = make_point_shell(make_tool("thesis"), 0.1);
  EXPECT_NEAR(static_cast<double>(shell.points.size()), 213000.0, 0.01 * 213000.0);
}

/// A face that lies just between two layers of cells counts once, wherever it lies.
TEST(PointShell, FlatFacesCountOnceAtEveryOffset) {
  for (const char* back : {"4", "4.025", "4.05", "4.075", "4.04999", "4.05001"}) {
    const Tool tool = make_tool(std::string("sphere 40,12 back ") + back);
    const PointShell shell = make_point_shell(tool, 0.1);
    EXPECT_NEAR(area_mm2(shell, SurfaceRole::smooth) / true_area_mm2(tool.profile, SurfaceRole::smooth), 1.0,
                0.02)
        << back;
  }
}

TEST(PointShell, SmoothPointsCanBeLeftOut) {
  const Tool tool = make_tool("sphere 10 nipple 2,3");
  const PointShell all = make_point_shell(tool, 0.2), working = make_point_shell(tool, 0.2, false);
  size_t expected = 0;
  for (const ShellPoint& p : all.points) expected += p.role != SurfaceRole::smooth;
  EXPECT_EQ(working.points.size(), expected);
  for (const ShellPoint& p : working.points) EXPECT_NE(p.role, SurfaceRole::smooth);
  EXPECT_LT(expected, all.points.size());
}

TEST(PointShell, TwoBuildsAreEqual) {
  const PointShell a = make_point_shell(make_tool("thesis"), 0.2),
                   b = make_point_shell(make_tool("thesis"), 0.2);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    ASSERT_EQ(a.points[i].morton, b.points[i].morton);
    ASSERT_EQ(a.points[i].normal, b.points[i].normal);
    ASSERT_EQ(a.points[i].surface_offset_mm, b.points[i].surface_offset_mm);
    ASSERT_EQ(a.points[i].role, b.points[i].role);
  }
}

TEST(PointShell, RefusesImpossibleSpacings) {
  const Tool tool = make_tool("sphere 20");
  for (const double spacing : {0.0, -0.1, std::nan(""), 0.015, 1e-9})
    test::expect_error(ErrorKind::invalid_input, "spacing", [&] { make_point_shell(tool, spacing); });
  EXPECT_GT(make_point_shell(tool, 40.0).points.size(), 0u);
}

TEST(PointShell, ThesisReamerMeshHasPointsOfEachRole) {
  const auto path = test::shared_data("mesh/reamer_4006.stl");
  REAM_SKIP_WITHOUT(path);
  const Tool tool = make_tool(path.string());
  const PointShell shell = make_point_shell(tool, 0.1);
  for (const SurfaceRole role : {SurfaceRole::cutting, SurfaceRole::guiding, SurfaceRole::smooth})
    EXPECT_NEAR(area_mm2(shell, role) / true_area_mm2(tool.profile, role), 1.0, 0.02)
        << static_cast<int>(role);
  RecordProperty("points", static_cast<int>(shell.points.size()));
}

}  // namespace
}  // namespace ream::shell
