#include "shell/meridian.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ream::shell {
namespace {

constexpr uint32_t meridian_seed = 20181;

/// Distance to points set densely on the profile; at most half a step too long.
double brute_force_distance(const ToolProfile& profile, double r, double z, double step_mm) {
  double nearest = 1e300;
  for (size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    const int steps = 1 + static_cast<int>(std::hypot(b.radius_mm - a.radius_mm, b.z_mm - a.z_mm) / step_mm);
    for (int k = 0; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      nearest = std::min(nearest, std::hypot(r - a.radius_mm - t * (b.radius_mm - a.radius_mm),
                                             z - a.z_mm - t * (b.z_mm - a.z_mm)));
    }
  }
  return nearest;
}

/// Even-odd rule along a line of constant radius towards +z.
bool brute_force_inside(const ToolProfile& profile, double r, double z) {
  bool inside = false;
  for (size_t i = 0; i + 1 < profile.points.size(); ++i) {
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    if ((a.radius_mm > r) == (b.radius_mm > r)) continue;
    const double t = (r - a.radius_mm) / (b.radius_mm - a.radius_mm);
    if (a.z_mm + t * (b.z_mm - a.z_mm) > z) inside = !inside;
  }
  return inside;
}

class MeridianOf : public testing::TestWithParam<const char*> {};

TEST_P(MeridianOf, AgreesWithBruteForce) {
  RecordProperty("seed", static_cast<int>(test::seed(meridian_seed)));
  SCOPED_TRACE("seed " + std::to_string(test::seed(meridian_seed)));
  const Tool tool = make_tool(GetParam());
  const Meridian meridian(tool.profile, 1.0);
  std::mt19937 random(test::seed(meridian_seed));
  std::uniform_real_distribution<double> radius(0.0, tool.profile.max_radius_mm() + 2.0),
      height(tool.profile.min_z_mm() - 2.0, tool.profile.max_z_mm() + 2.0);
  const double step = 0.01;
  for (int i = 0; i < 500; ++i) {
    const double r = radius(random), z = height(random);
    const MeridianHit hit = meridian.nearest(r, z);
    const double expected = brute_force_distance(tool.profile, r, z, step);
    EXPECT_LE(std::abs(hit.signed_distance_mm), expected + 1e-12);
    EXPECT_NEAR(std::abs(hit.signed_distance_mm), expected, step);
    if (expected > 1e-6) {
      EXPECT_EQ(hit.signed_distance_mm < 0.0, brute_force_inside(tool.profile, r, z)) << r << " " << z;
    }
    EXPECT_NEAR(std::hypot(hit.normal_radial, hit.normal_z), 1.0, 1e-12);

    const MeridianHit slow = nearest_on_profile(tool.profile, r, z);
    EXPECT_EQ(hit.segment, slow.segment);
    EXPECT_EQ(hit.signed_distance_mm, slow.signed_distance_mm);
  }
}

/// The step back along the normal ends on the surface, from near and far, on faces and corners.
TEST_P(MeridianOf, NormalLeadsToTheSurface) {
  const Tool tool = make_tool(GetParam());
  const Meridian meridian(tool.profile, 1.0);
  std::mt19937 random(test::seed(meridian_seed));
  std::uniform_int_distribution<size_t> segment(0, tool.profile.roles.size() - 1);
  std::uniform_real_distribution<double> along(0.0, 1.0), off(-0.2, 0.2);
  for (int i = 0; i < 500; ++i) {
    const size_t s = segment(random);
    const ProfilePoint &a = tool.profile.points[s], &b = tool.profile.points[s + 1];
    const double t = along(random);
    const double r = std::abs(a.radius_mm + t * (b.radius_mm - a.radius_mm) + off(random));
    const double z = a.z_mm + t * (b.z_mm - a.z_mm) + off(random);
    const MeridianHit hit = meridian.nearest(r, z);
    const double back_r = r - hit.signed_distance_mm * hit.normal_radial;
    const double back_z = z - hit.signed_distance_mm * hit.normal_z;
    EXPECT_LT(std::abs(nearest_on_profile(tool.profile, std::abs(back_r), back_z).signed_distance_mm), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, MeridianOf,
                         testing::Values("sphere 20", "sphere 3", "thesis",
                                         "ellipse 18.25,9 nipple 3,8 back 2"));

TEST(Simplified, StaysWithinToleranceAndKeepsRoles) {
  const ToolProfile fine = make_tool("thesis").profile;
  const ToolProfile coarse = simplified(fine, 0.01);
  EXPECT_LT(coarse.points.size(), fine.points.size() / 3);
  for (const ProfilePoint& p : fine.points)
    EXPECT_LE(std::abs(nearest_on_profile(coarse, p.radius_mm, p.z_mm).signed_distance_mm), 0.01 + 1e-12);
  for (size_t i = 0; i < fine.roles.size(); ++i) {
    const ProfilePoint &a = fine.points[i], &b = fine.points[i + 1];
    const double r = 0.5 * (a.radius_mm + b.radius_mm), z = 0.5 * (a.z_mm + b.z_mm);
    EXPECT_EQ(coarse.roles[nearest_on_profile(coarse, r, z).segment], fine.roles[i]) << r << " " << z;
  }
}

}  // namespace
}  // namespace ream::shell
