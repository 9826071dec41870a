#include "shell/tool.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "core/units.hpp"
#include "support/expect_error.hpp"

namespace ream::shell {
namespace {

/// Volume by Pappus' theorem: frusta between neighbouring corners.
double pappus_volume_mm3(const ToolProfile& profile) {
  double volume = 0.0;
  for (size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const double a = profile.points[i].radius_mm, b = profile.points[i + 1].radius_mm;
    volume += pi / 3.0 * (a * a + a * b + b * b) * (profile.points[i].z_mm - profile.points[i + 1].z_mm);
  }
  return volume;
}

/// Every edge lies between exactly two triangles, once in each direction.
void expect_closed(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_NE(t[k], t[(k + 1) % 3]);
      ++uses[{t[k], t[(k + 1) % 3]}];
    }
  for (const auto& [edge, count] : uses) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(uses.contains({edge.second, edge.first}));
  }
  EXPECT_EQ(mesh.vertices_mm.size() + mesh.triangles.size() - uses.size() / 2, 2u)
      << "Euler number of a sphere";
}

void expect_well_formed(const ToolProfile& profile) {
  ASSERT_GE(profile.points.size(), 3u);
  ASSERT_EQ(profile.roles.size() + 1, profile.points.size());
  EXPECT_EQ(profile.points.front().radius_mm, 0.0);
  EXPECT_EQ(profile.points.back().radius_mm, 0.0);
  EXPECT_EQ(profile.points.front().z_mm, profile.max_z_mm());
  for (size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    EXPECT_GT(std::hypot(a.radius_mm - b.radius_mm, a.z_mm - b.z_mm), 1e-6) << "at " << i;
    EXPECT_GE(a.radius_mm, 0.0);
  }
}

TEST(ParametricTool, SphereFollowsItsRadius) {
  const Tool tool = make_tool("sphere 20");
  expect_well_formed(tool.profile);
  EXPECT_DOUBLE_EQ(tool.profile.max_radius_mm(), 18.25);
  EXPECT_DOUBLE_EQ(tool.profile.max_z_mm(), 0.0);
  int cutting = 0;
  for (size_t i = 0; i < tool.profile.roles.size(); ++i) {
    if (tool.profile.roles[i] != SurfaceRole::cutting) continue;
    ++cutting;
    const ProfilePoint &a = tool.profile.points[i], &b = tool.profile.points[i + 1];
    EXPECT_NEAR(std::hypot(b.radius_mm, b.z_mm + 20.0), 20.0, 1e-12);
    const double sag = 20.0 - std::hypot(0.5 * (a.radius_mm + b.radius_mm), 0.5 * (a.z_mm + b.z_mm) + 20.0);
    EXPECT_LT(sag, 0.002);
  }
  EXPECT_GT(cutting, 50);
  EXPECT_LT(cutting, 500);
}

TEST(ParametricTool, EllipseFollowsAppendixA) {
  const Tool tool = make_tool("ellipse 18.25,9");
  expect_well_formed(tool.profile);
  for (size_t i = 0; i < tool.profile.roles.size(); ++i) {
    if (tool.profile.roles[i] != SurfaceRole::cutting) continue;
    const ProfilePoint& p = tool.profile.points[i + 1];
    const double r = p.radius_mm / 18.25, z = (p.z_mm + 9.0) / 9.0;
    EXPECT_NEAR(r * r + z * z, 1.0, 1e-12);
  }
}

TEST(ParametricTool, NippleGuidesAndBackHasItsHeight) {
  const Tool tool = make_tool("sphere 25,15 nipple 3,8 back 6");
  expect_well_formed(tool.profile);
  EXPECT_DOUBLE_EQ(tool.profile.max_z_mm(), 8.0);
  EXPECT_EQ(tool.profile.roles[0], SurfaceRole::guiding);
  EXPECT_EQ(tool.profile.roles[1], SurfaceRole::guiding);
  EXPECT_EQ(tool.profile.roles[2], SurfaceRole::cutting);
  EXPECT_DOUBLE_EQ(tool.profile.points[1].radius_mm, 3.0);
  EXPECT_NEAR(tool.profile.points[2].z_mm, -25.0 + std::sqrt(625.0 - 9.0), 1e-12);
  size_t i = 2;
  while (tool.profile.roles[i] == SurfaceRole::cutting) ++i;
  EXPECT_DOUBLE_EQ(tool.profile.points[i].radius_mm, 15.0);
  EXPECT_NEAR(tool.profile.points[i].z_mm - tool.profile.points[i + 1].z_mm, 6.0, 1e-12);
  for (; i < tool.profile.roles.size(); ++i) EXPECT_EQ(tool.profile.roles[i], SurfaceRole::smooth);
}

TEST(ParametricTool, ThesisToolIsNamed) {
  const Tool named = make_tool("thesis"), spelled = make_tool(thesis_tool);
  ASSERT_EQ(named.profile.points.size(), spelled.profile.points.size());
  EXPECT_EQ(named.name, "thesis");
  EXPECT_EQ(named.mesh.vertices_mm, spelled.mesh.vertices_mm);
}

TEST(ParametricTool, RefusesWhatItDoesNotKnow) {
  for (const char* text : {"cube 3",
                           "",
                           "sphere",
                           "sphere x",
                           "sphere 0",
                           "sphere -3",
                           "sphere nan",
                           "sphere inf",
                           "sphere 1e9",
                           "sphere 10,20",
                           "sphere 10,5,2",
                           "sphere 10,",
                           "ellipse 3",
                           "ellipse 3,4,5",
                           "sphere 10 nipple 3",
                           "sphere 10 nipple 10,2",
                           "sphere 10 back",
                           "sphere 10 wide 3",
                           "sphere 10 back 3 nipple 2,2",
                           "sphere 10 sphere 12",
                           "thesis back 3",
                           "spheres 3"})
    test::expect_error(ErrorKind::usage, "\"sphere R[,outer]\"", [&] { make_tool(text); });
  test::expect_error(ErrorKind::not_found, "absent.stl", [] { make_tool("absent.stl"); });
}

TEST(Revolve, IsClosedAndHasPappusVolume) {
  for (const char* text :
       {"sphere 20", "sphere 2", "ellipse 18.25,9 nipple 3,8", "thesis", "sphere 40,18 back 1"}) {
    const Tool tool = make_tool(text);
    const int segments = 360;
    const TriangleMesh mesh = revolve(tool.profile, segments);
    expect_closed(mesh);
    expect_closed(tool.mesh);
    // A regular polygon of n sides has n/2 sin(2 pi / n) of the area over r^2.
    const double share = segments / (2.0 * pi) * std::sin(2.0 * pi / segments);
    const double expected = share * pappus_volume_mm3(tool.profile);
    EXPECT_NEAR(mesh.volume_mm3(), expected, 1e-5 * expected) << text;
    EXPECT_GT(tool.mesh.volume_mm3(), 0.99 * pappus_volume_mm3(tool.profile)) << text;
  }
}

TEST(Revolve, HalfBallHasItsAnalyticVolume) {
  const Tool tool = make_tool("sphere 10 back 2");
  const double shaft = pi * 16.0 * 5.0, expected = 2.0 / 3.0 * pi * 1000.0 + pi * 100.0 * 2.0 + shaft;
  EXPECT_NEAR(pappus_volume_mm3(tool.profile), expected, 1e-4 * expected);
}

}  // namespace
}  // namespace ream::shell
