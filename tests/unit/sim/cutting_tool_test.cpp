#include "sim/cutting_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "shell/parametric_profile.hpp"

namespace ream::sim {
namespace {

using shell::SurfaceRole;

shell::ToolProfile profile_of(const std::string& words) { return shell::parametric_profile(words); }

TEST(CuttingLip, LipReachesFromItsOffsetToTheRim) {
  for (const char* words : {"ellipse 18.25,9", "sphere 8,5", "sphere 30"}) {
    const shell::ToolProfile profile = profile_of(words);
    const force::Lip lip = cutting_lip(profile);
    const double rim = profile.max_radius_mm();
    EXPECT_NEAR(lip.offset_mm, rim * std::sin(radians_from_degrees(9.46)), 1e-12) << words;
    double at = lip.offset_mm;
    for (const force::LipElement& e : lip.elements) {
      EXPECT_NEAR(e.radius_mm - 0.5 * e.radial_width_mm, at, 1e-9) << words;
      EXPECT_GT(e.radial_width_mm, 0.0) << words;
      EXPECT_LE(e.radial_width_mm, 0.1) << words;
      EXPECT_NEAR(std::hypot(e.point_angle_sine, e.point_angle_cosine), 1.0, 1e-12) << words;
      at = e.radius_mm + 0.5 * e.radial_width_mm;
    }
    EXPECT_NEAR(at, rim, 1e-9) << words;
  }
}

TEST(CuttingLip, PointAnglesAreTheEllipses) {
  constexpr double a = 18.25, b = 9.0;
  for (const force::LipElement& e : cutting_lip(profile_of("ellipse 18.25,9")).elements) {
    const double rise = b * e.radius_mm / (a * std::sqrt(a * a - e.radius_mm * e.radius_mm));
    if (e.radius_mm < 0.99 * a) {
      EXPECT_NEAR(e.point_angle_cosine / e.point_angle_sine, rise, 0.005 * (1.0 + rise)) << e.radius_mm;
      // As printed, A.7 lacks 1/b: its tangent is nine times too large.
      const double printed = a * std::sqrt(a * a - e.radius_mm * e.radius_mm) / e.radius_mm;
      EXPECT_GT(printed * e.point_angle_cosine, 8.0 * e.point_angle_sine) << e.radius_mm;
    }
  }
}

TEST(CuttingLip, ANippleHasNoLip) {
  const force::Lip lip = cutting_lip(profile_of("thesis"));
  EXPECT_NEAR(lip.offset_mm, 16.0 * std::sin(radians_from_degrees(9.46)), 1e-12);
  EXPECT_NEAR(lip.elements.front().radius_mm - 0.5 * lip.elements.front().radial_width_mm, 3.0, 1e-12);
}

TEST(CuttingLip, WallsAndHiddenPartsCutNothing) {
  // A flat to 6 mm, a step back, a groove that a wider part covers, and a hollow that comes forward again.
  const shell::ToolProfile profile{
      {{0.0, 0.0},
       {6.0, 0.0},
       {6.0, -1.0},
       {5.0, -1.5},
       {8.0, -2.0},
       {10.0, -1.8},
       {10.0, -6.0},
       {0.0, -6.0}},
      {SurfaceRole::cutting, SurfaceRole::cutting, SurfaceRole::cutting, SurfaceRole::cutting,
       SurfaceRole::cutting, SurfaceRole::smooth, SurfaceRole::smooth}};
  const force::Lip lip = cutting_lip(profile);
  double length = lip.offset_mm;
  for (const force::LipElement& e : lip.elements) {
    length += e.radial_width_mm;
    if (e.radius_mm < 6.0) {
      EXPECT_EQ(e.point_angle_cosine, 0.0);
    }
    if (e.radius_mm > 8.0) {
      EXPECT_LT(e.point_angle_cosine, 0.0);
    }
  }
  EXPECT_NEAR(length, 10.0, 1e-9);
}

}  // namespace
}  // namespace ream::sim
