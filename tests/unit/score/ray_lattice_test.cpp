#include "score/ray_lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

using case_::Side;

Vec3 mirrored(const Vec3& v) { return {-v.x(), v.y(), v.z()}; }

RayLattice lattice(Side side = Side::right) {
  return {Vec3(1, 2, 3), Vec3(0.3, -0.9, 0.2).normalized(), side, 5.0, 0.25};
}

TEST(RayLattice, GoesIntoTheWorldAndBack) {
  std::mt19937 random(test::seed(5));
  const RayLattice rays = lattice();
  for (int i = 0; i < 20; ++i) {
    const Vec3 p = test::random_vector(random, 10.0);
    EXPECT_LT((rays.in_lattice(rays.world(p)) - p).norm(), 1e-12);
    EXPECT_LT((rays.lattice_direction(rays.world_direction(p)) - p).norm(), 1e-12);
  }
  EXPECT_LT((rays.world_direction(Vec3::UnitZ()) - Vec3(0.3, -0.9, 0.2).normalized()).norm(), 1e-12);
}

TEST(RayLattice, OfAMirroredCaseIsItsMirrorImageToTheBit) {
  std::mt19937 random(test::seed(6));
  for (int round = 0; round < 10; ++round) {
    const Vec3 origin = test::random_vector(random, 100.0),
               along = test::random_vector(random, 1.0).normalized();
    const RayLattice right(origin, along, Side::right, 6.0, 0.25),
        left(mirrored(origin), mirrored(along), Side::left, 6.0, 0.25);
    ASSERT_EQ(right.size(), left.size());
    for (size_t ray = 0; ray < right.size(); ray += 17)
      EXPECT_EQ(mirrored(right.world(ray, 1.7)), left.world(ray, 1.7));
  }
}

TEST(RayLattice, HoldsTheRaysOfADisc) {
  const RayLattice rays = lattice();
  EXPECT_NEAR(static_cast<double>(rays.size()) * rays.cell_area_mm2(), 3.14159 * 25.0, 0.5);
  for (size_t ray = 0; ray < rays.size(); ++ray) {
    EXPECT_EQ(rays.nearest(rays.x_mm(ray), rays.y_mm(ray)), static_cast<int>(ray));
    const int beside = rays.neighbour(ray, 1, -2);
    if (beside < 0) continue;
    EXPECT_NEAR(rays.x_mm(static_cast<size_t>(beside)) - rays.x_mm(ray), 0.25, 1e-12);
    EXPECT_NEAR(rays.y_mm(static_cast<size_t>(beside)) - rays.y_mm(ray), -0.5, 1e-12);
  }
  EXPECT_EQ(rays.nearest(5.2, 0.0), -1);
  EXPECT_EQ(rays.nearest(4.9, 4.9), -1);
}

TEST(RayLattice, InterpolatesAPlaneExactly) {
  const RayLattice rays = lattice();
  std::vector<double> values(rays.size());
  for (size_t ray = 0; ray < rays.size(); ++ray)
    values[ray] = 1.0 + 2.0 * rays.x_mm(ray) - 0.5 * rays.y_mm(ray);
  EXPECT_NEAR(rays.between(values, 1.234, -2.345), 1.0 + 2.468 + 1.1725, 1e-12);
  values[static_cast<size_t>(rays.nearest(1.25, -2.25))] = no_surface_mm;
  EXPECT_EQ(rays.between(values, 1.234, -2.345), no_surface_mm);
  EXPECT_EQ(rays.between(values, 7.0, 0.0), no_surface_mm);
}

TEST(RayLattice, SmoothingKeepsPlanesAndSteps) {
  const RayLattice rays = lattice();
  std::vector<double> values(rays.size());
  for (size_t ray = 0; ray < rays.size(); ++ray)
    values[ray] = 0.3 * rays.x_mm(ray) + (rays.y_mm(ray) > 0.1 ? 1.0 : 0.0);
  const auto smooth = rays.smoothed(values, 0.6, 0.5);
  for (size_t ray = 0; ray < rays.size(); ++ray)
    if (std::hypot(rays.x_mm(ray), rays.y_mm(ray)) < 4.0) {
      EXPECT_NEAR(smooth[ray], values[ray], 1e-12);
    }
}

TEST(RayLattice, ThinnedHasEveryFourthRay) {
  std::vector<size_t> kept;
  const RayLattice rays = lattice(), thin = rays.thinned(4, kept);
  ASSERT_EQ(thin.size(), kept.size());
  EXPECT_EQ(thin.spacing_mm(), 1.0);
  for (size_t ray = 0; ray < thin.size(); ++ray) {
    EXPECT_EQ(thin.world(ray, 2.0), rays.world(kept[ray], 2.0));
    EXPECT_EQ(thin.nearest(thin.x_mm(ray), thin.y_mm(ray)), static_cast<int>(ray));
  }
}

}  // namespace
}  // namespace ream::score
