#include "sim/cutting_surface.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::sim {
namespace {

TEST(SurfacePlace, OfASphereIsItsCentrePlusTheRadius) {
  const SurfacePlace place(shell::make_tool("sphere 8").profile);
  const uint32_t seed = test::seed(5);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  for (int i = 0; i < 500; ++i) {
    Vec3 normal = test::random_direction(random);
    normal.z() = std::abs(normal.z());
    if (normal.z() < 0.4) continue;  // steeper than any cap's rim
    const Vec3 expected_mm = Vec3(0, 0, -8.0) + 8.0 * normal;
    ASSERT_LT((place.point_mm(normal) - expected_mm).norm(), 0.15) << normal.transpose();
  }
}

TEST(SurfacePlace, OfAnEllipseLiesOnItWithThatNormal) {
  const SurfacePlace place(shell::make_tool("ellipse 18.25,9").profile);
  for (const double r : {2.0, 6.0, 10.0, 14.0}) {
    const double z = -9.0 + 9.0 * std::sqrt(1.0 - r * r / (18.25 * 18.25));
    const Vec3 gradient(r / (18.25 * 18.25), 0.0, (z + 9.0) / 81.0);
    EXPECT_LT((place.point_mm(gradient.normalized()) - Vec3(r, 0, z)).norm(), 0.1) << r;
  }
}

TEST(SurfacePlace, AlongTheAxisIsTheApex) {
  const SurfacePlace place(shell::make_tool("sphere 8,5").profile);
  EXPECT_LT(place.point_mm(Vec3::UnitZ()).norm(), 0.1);
}

}  // namespace
}  // namespace ream::sim
