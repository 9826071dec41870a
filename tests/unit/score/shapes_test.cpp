#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "core/units.hpp"
#include "score/component_library.hpp"
#include "score/cutting_surface.hpp"
#include "score/sphere_fit.hpp"
#include "support/expect_error.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

TEST(CuttingMeridian, IsThatOfTheWords) {
  const CuttingMeridian sphere(shell::make_tool("sphere 30,12").profile);
  const CuttingMeridian ellipse(shell::make_tool("ellipse 18.25,9").profile);
  EXPECT_DOUBLE_EQ(sphere.outer_mm(), 12.0);
  EXPECT_DOUBLE_EQ(ellipse.outer_mm(), 18.25);
  for (double r = 0.0; r <= 12.0; r += 0.7) {
    EXPECT_NEAR(sphere.behind_mm(r), 30.0 - std::sqrt(900.0 - r * r), 1e-3);
    EXPECT_NEAR(sphere.slope_cosine(r), std::sqrt(900.0 - r * r) / 30.0, 0.01);
    EXPECT_NEAR(ellipse.behind_mm(r), 9.0 - 9.0 * std::sqrt(1.0 - r * r / (18.25 * 18.25)), 1e-3);
    EXPECT_NEAR(CuttingMeridian::sphere(30.0, 12.0).behind_mm(r), sphere.behind_mm(r), 1e-3);
  }
}

TEST(CuttingMeridian, IsFlatWithinANipple) {
  const CuttingMeridian meridian(shell::make_tool("sphere 30,12 nipple 3,8").profile);
  EXPECT_EQ(meridian.behind_mm(0.0), meridian.behind_mm(2.9));
  EXPECT_NEAR(meridian.behind_mm(3.0), 30.0 - std::sqrt(891.0), 1e-3);
}

TEST(CuttingMeridian, NeedsACuttingSurface) {
  shell::ToolProfile profile = shell::make_tool("sphere 30,12").profile;
  for (shell::SurfaceRole& role : profile.roles) role = shell::SurfaceRole::smooth;
  test::expect_error(ErrorKind::invalid_input, "cutting", [&] { CuttingMeridian made(profile); });
}

/// Points of a cap of a sphere, with noise along the radius.
std::vector<Vec3> cap(const Vec3& centre, double radius, double noise, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 way = Vec3(0.4 * number(random), 0.4 * number(random), -1.0).normalized();
    points.push_back(centre + (radius + noise * number(random)) * way);
  }
  return points;
}

TEST(SphereFit, FindsASphereByItsCap) {
  std::mt19937 random(test::seed(15));
  const Vec3 centre(100.0, -50.0, 30.0);
  const auto exact = fit_sphere(cap(centre, 35.0, 0.0, random));
  EXPECT_NEAR((exact->centre_mm - centre).norm(), 0.0, 1e-6);
  EXPECT_NEAR(exact->radius_mm, 35.0, 1e-6);
  EXPECT_NEAR(exact->mean_deviation_mm, 0.0, 1e-9);
  const auto rough = fit_sphere(cap(centre, 35.0, 0.2, random));
  EXPECT_NEAR(rough->radius_mm, 35.0, 0.5);
  EXPECT_NEAR(rough->mean_deviation_mm, 0.1, 0.005) << "the mean of an even spread of 0.2 mm";
}

TEST(SphereFit, OfWhatIsNoSphereIsNotSaid) {
  std::vector<Vec3> plane, line, few;
  for (int i = 0; i < 100; ++i) {
    plane.emplace_back(i % 10, i / 10, 0.0);
    line.emplace_back(i, 2.0 * i, 0.0);
    if (i < 11) few.emplace_back(i % 3, i / 3, i * i);
  }
  EXPECT_FALSE(fit_sphere(plane));
  EXPECT_FALSE(fit_sphere(line));
  EXPECT_FALSE(fit_sphere(few));
  EXPECT_FALSE(fit_sphere(std::vector<Vec3>(50, Vec3(1, 2, 3))));
}

TEST(DepthPlaneFit, FindsThePlaneThroughMostPoints) {
  std::mt19937 random(test::seed(16));
  std::uniform_real_distribution<double> number(-10.0, 10.0), rough(-0.05, 0.05);
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) {
    const double x = number(random), y = number(random);
    points.emplace_back(x, y, 3.0 + 0.2 * x - 0.1 * y + rough(random));
  }
  const Vec3 normal = Vec3(-0.2, 0.1, 1.0).normalized();
  const auto turned = [&](const std::vector<Vec3>& from) {
    return std::acos(std::min(1.0, fit_depth_plane(from, 0.25)->dot(normal))) * 180.0 / pi;
  };
  EXPECT_LT(turned(points), 0.1);
  // A twentieth of them, all on one side, is 4 mm deeper. Least squares would turn by 0.9 degrees.
  for (Vec3& p : points)
    if (p.x() > 9.0) p.z() += 4.0;
  EXPECT_LT(turned(points), 0.3);
}

TEST(DepthPlaneFit, OfALineThereIsNone) {
  EXPECT_FALSE(fit_depth_plane(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, 0.25));
  EXPECT_FALSE(fit_depth_plane(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, 0.25));
}

TEST(ComponentLibrary, PointsLieOnPegsAndKeels) {
  std::set<std::string_view> names;
  for (const LibraryComponent& component : component_library()) {
    SCOPED_TRACE(component.name);
    EXPECT_TRUE(names.insert(component.name).second);
    EXPECT_EQ(find_component(component.name), &component);
    EXPECT_EQ(component.thickness_mm, 4.0) << "the catalogue says so";
    const auto parts = surface_points(component);
    ASSERT_EQ(parts.size(), component.pegs.size() + component.keels.size());
    for (size_t i = 0; i < component.pegs.size(); ++i) {
      const Peg& peg = component.pegs[i];
      double deepest = 0.0;
      for (const Vec3& p : parts[i]) {
        deepest = std::max(deepest, p.z());
        EXPECT_LE(std::hypot(p.x() - peg.anterior_mm, p.y() - peg.superior_mm), 0.5 * peg.diameter_mm + 1e-9);
      }
      EXPECT_EQ(deepest, peg.length_mm);
    }
    for (size_t i = 0; i < component.keels.size(); ++i) {
      const Keel& keel = component.keels[i];
      double widest = 0.0, deepest = 0.0;
      for (const Vec3& p : parts[component.pegs.size() + i]) {
        widest = std::max(widest, std::abs(p.y()));
        deepest = std::max(deepest, p.z());
      }
      EXPECT_GT(widest, 0.5 * keel.height_mm - 1.0);
      EXPECT_LE(widest, 0.5 * keel.height_mm);
      EXPECT_DOUBLE_EQ(deepest, keel.length_mm);
    }
  }
}

TEST(ComponentLibrary, APlanNamesItsComponent) {
  EXPECT_EQ(component_of(std::nullopt).name, "pegged medium");
  case_::Plan plan;
  EXPECT_EQ(component_of(plan).name, "pegged medium");
  plan.implant_size = "Keeled Large";
  EXPECT_EQ(component_of(plan).name, "keeled large");
  plan.implant_size = "M40";  // a maker's
  EXPECT_EQ(&component_of(plan), &virtual_component());
  EXPECT_EQ(find_component(""), nullptr);
}

}  // namespace
}  // namespace ream::score
