#include "shell/swept_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::shell {
namespace {

constexpr uint32_t swept_profile_seed = 20182;
constexpr double margin_mm = 1.0;

float at(const SweptProfile& table, double radius_mm, double z_mm) {
  const auto r = static_cast<float>(radius_mm);
  return table.at(r * r, static_cast<float>(z_mm));
}

/// Corners of the body where the distance has kinks: the rim, and behind it.
bool near_a_corner(const SweptProfile& table, double rim_z_mm, double r, double z) {
  const double room = 0.3;
  return std::abs(r - table.max_radius_mm) < room &&
         (std::abs(z - rim_z_mm) < room || std::abs(z - table.body_min_z_mm) < room);
}

TEST(SweptDistance, IsThatOfTheBallAheadOfTheCap) {
  const ToolProfile profile = make_tool("sphere 20").profile;
  const double rim_z = std::sqrt(400.0 - 18.25 * 18.25) - 20.0;
  std::mt19937 random(test::seed(swept_profile_seed));
  std::uniform_real_distribution<double> share(0.0, 0.98), off(-0.4, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const double angle = share(random) * std::asin(18.25 / 20.0), reach = 20.0 + off(random);
    const double r = reach * std::sin(angle), z = reach * std::cos(angle) - 20.0;
    if (z < rim_z + 0.4) continue;  // the back may be nearer
    EXPECT_NEAR(swept_distance_mm(profile, r, z), reach - 20.0, 5e-4)
        << "seed " << test::seed(swept_profile_seed);
  }
}

/// Side and back are flat: distances there are those of a cylinder's face and edge.
TEST(SweptDistance, BackIsAPlaneBehindTheRim) {
  const ToolProfile profile = make_tool("sphere 20").profile;
  const double back_z = std::sqrt(400.0 - 18.25 * 18.25) - 20.0 - rim_backing_mm;
  EXPECT_NEAR(swept_distance_mm(profile, 5.0, back_z - 0.7), 0.7, 1e-12);
  EXPECT_NEAR(swept_distance_mm(profile, 5.0, back_z + 0.7), -0.7, 1e-12);
  EXPECT_NEAR(swept_distance_mm(profile, 18.25 + 0.3, back_z + 0.25), 0.3, 1e-12);
  EXPECT_NEAR(swept_distance_mm(profile, 18.25 + 0.3, back_z - 0.4), 0.5, 1e-12);
}

TEST(SweptDistance, NippleDoesNotCut) {
  const ToolProfile profile = make_tool("sphere 20 nipple 3,8").profile;
  const double flat_z = std::sqrt(391.0) - 20.0;
  EXPECT_NEAR(swept_distance_mm(profile, 0.0, 5.0), 5.0 - flat_z, 1e-12);
  EXPECT_NEAR(swept_distance_mm(profile, 2.0, 0.5), 0.5 - flat_z, 1e-12);
  EXPECT_NEAR(swept_distance_mm(profile, 1.0, flat_z - 0.2), -0.2, 1e-12);
  const SweptProfile table = swept_profile(profile, margin_mm);
  EXPECT_NEAR(table.body_max_z_mm, flat_z, 1e-12);
}

/// Against points set densely on the body of a ball cut by planes, an independent construction.
TEST(SweptDistance, AgreesWithDenseSampling) {
  const double R = 20.0, outer = 18.25, rim_z = std::sqrt(R * R - outer * outer) - R,
               back_z = rim_z - rim_backing_mm;
  std::vector<ProfilePoint> dense;
  for (int i = 0; i <= 20000; ++i) {
    const double t = i / 20000.0, angle = t * std::asin(outer / R);
    dense.push_back({R * std::sin(angle), R * std::cos(angle) - R});
    dense.push_back({t * outer, back_z});
    dense.push_back({outer, rim_z + t * (back_z - rim_z)});
  }
  const auto inside = [&](double r, double z) { return z > back_z && r < outer && std::hypot(r, z + R) < R; };
  const ToolProfile profile = make_tool("sphere 20").profile;
  std::mt19937 random(test::seed(swept_profile_seed));
  std::uniform_real_distribution<double> radius(0.0, 20.0), height(back_z - 2.0, 2.0);
  for (int i = 0; i < 300; ++i) {
    const double r = radius(random), z = height(random);
    double nearest = 1e300;
    for (const ProfilePoint& p : dense) nearest = std::min(nearest, std::hypot(r - p.radius_mm, z - p.z_mm));
    if (nearest < 1e-3) continue;
    EXPECT_NEAR(swept_distance_mm(profile, r, z), inside(r, z) ? -nearest : nearest, 1e-3)
        << "seed " << test::seed(swept_profile_seed);
  }
}

class SweptTable : public testing::TestWithParam<const char*> {};

TEST_P(SweptTable, IsWithin5MicrometresAtTheCuttingSurface) {
  const Tool tool = make_tool(GetParam());
  const SweptProfile table = swept_profile(tool.profile, margin_mm);
  std::mt19937 random(test::seed(swept_profile_seed));
  std::uniform_real_distribution<double> off(-0.3, 0.9), along(0.0, 1.0);
  double rim_z = 0.0;
  for (size_t i = 0; i < tool.profile.roles.size(); ++i)
    if (tool.profile.roles[i] == SurfaceRole::cutting) rim_z = tool.profile.points[i + 1].z_mm;
  double worst = 0.0;
  int tried = 0;
  for (int round = 0; round < 20; ++round)
    for (size_t i = 0; i < tool.profile.roles.size(); ++i) {
      if (tool.profile.roles[i] != SurfaceRole::cutting) continue;
      const ProfilePoint &a = tool.profile.points[i], &b = tool.profile.points[i + 1];
      const double dr = b.radius_mm - a.radius_mm, dz = b.z_mm - a.z_mm, length = std::hypot(dr, dz);
      const double t = along(random), d = off(random);
      const double r = a.radius_mm + t * dr - d * dz / length, z = a.z_mm + t * dz + d * dr / length;
      if (near_a_corner(table, rim_z, r, z) || r < 0.0) continue;
      if (d < 0.0 && z - table.body_min_z_mm < 0.35) continue;  // the medial surface to the back is near
      ++tried;
      worst = std::max(worst, std::abs(at(table, r, z) - swept_distance_mm(tool.profile, r, z)));
    }
  EXPECT_GT(tried, 500);
  EXPECT_LT(worst, 0.005) << "seed " << test::seed(swept_profile_seed);
}

TEST_P(SweptTable, SignAgreesAwayFromTheSurface) {
  const Tool tool = make_tool(GetParam());
  const SweptProfile table = swept_profile(tool.profile, margin_mm);
  std::mt19937 random(test::seed(swept_profile_seed));
  std::uniform_real_distribution<double> radius(0.0, table.max_radius_mm + 0.9),
      height(table.body_min_z_mm - 0.9, table.body_max_z_mm + 0.9);
  for (int i = 0; i < 5000; ++i) {
    const double r = radius(random), z = height(random), exact = swept_distance_mm(tool.profile, r, z);
    if (std::abs(exact) < 0.03) continue;
    EXPECT_EQ(at(table, r, z) < 0.0f, exact < 0.0)
        << r << " " << z << " seed " << test::seed(swept_profile_seed);
    EXPECT_NEAR(at(table, r, z), exact, 0.03);
  }
}

TEST_P(SweptTable, CoversItsMarginAndIsFarBeyond) {
  const Tool tool = make_tool(GetParam());
  const SweptProfile table = swept_profile(tool.profile, margin_mm);
  const double r = table.max_radius_mm, top = table.body_max_z_mm, bottom = table.body_min_z_mm;
  for (double radius = 0.0; radius <= r + margin_mm; radius += 0.1) {
    EXPECT_LT(at(table, radius, top + margin_mm - 1e-4), SweptProfile::far);
    EXPECT_LT(at(table, radius, bottom - margin_mm + 1e-4), SweptProfile::far);
  }
  for (double z = bottom - margin_mm + 1e-4; z < top + margin_mm; z += 0.1)
    EXPECT_LT(at(table, r + margin_mm - 1e-4, z), SweptProfile::far);
  EXPECT_EQ(at(table, 0.0, top + 2.0 * margin_mm), SweptProfile::far);
  EXPECT_EQ(at(table, 0.0, bottom - 2.0 * margin_mm), SweptProfile::far);
  EXPECT_EQ(at(table, r + 2.0 * margin_mm, top), SweptProfile::far);
  EXPECT_EQ(table.at(std::nanf(""), 0.0f), SweptProfile::far);
  EXPECT_EQ(table.at(0.0f, std::nanf("")), SweptProfile::far);
}

INSTANTIATE_TEST_SUITE_P(Tools, SweptTable,
                         testing::Values("sphere 20", "sphere 40,18", "sphere 5", "thesis", "ellipse 18.25,9",
                                         "ellipse 18.25,9 nipple 3,8"));

TEST(SweptTableAlone, TwoBuildsAreEqual) {
  const ToolProfile profile = make_tool("thesis").profile;
  EXPECT_EQ(swept_profile(profile, margin_mm).distance_mm, swept_profile(profile, margin_mm).distance_mm);
}

TEST(SweptTableAlone, RefusesAToolThatDoesNotCut) {
  ToolProfile profile = make_tool("sphere 5").profile;
  for (SurfaceRole& role : profile.roles) role = SurfaceRole::smooth;
  test::expect_error(ErrorKind::invalid_input, "cutting", [&] { swept_profile(profile, margin_mm); });
}

}  // namespace
}  // namespace ream::shell
