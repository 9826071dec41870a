#include "geometry/triangle_tree.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ream {
namespace {

TriangleMesh soup(std::mt19937& random, int triangles) {
  std::uniform_real_distribution<float> place(-10.0f, 10.0f), size(-2.0f, 2.0f);
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vec3f at(place(random), place(random), place(random));
    const auto base = static_cast<uint32_t>(mesh.vertices_mm.size());
    for (int k = 0; k < 3; ++k)
      mesh.vertices_mm.emplace_back(at + Vec3f(size(random), size(random), size(random)));
    mesh.triangles.push_back({base, base + 1, base + 2});
  }
  // A triangle without area, as importers may leave them.
  mesh.triangles.push_back({0, 0, 1});
  return mesh;
}

/// Nearest of points sampled densely on the triangle: never below the true distance, and little above.
double sampled_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr int steps = 200;
  double best = 1e300;
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; k <= steps - i; ++k) {
      const Vec3 on = a + (b - a) * i / steps + (c - a) * k / steps;
      best = std::min(best, (p - on).norm());
    }
  return best;
}

TEST(TriangleTree, DistanceToATriangleIsThatToItsNearestPoint) {
  std::mt19937 random(test::seed(61));
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  for (int round = 0; round < 60; ++round) {
    Vec3 points[4];
    for (Vec3& point : points) point = Vec3(place(random), place(random), place(random));
    const double sampled = sampled_distance(points[0], points[1], points[2], points[3]);
    const double computed = triangle_distance_mm(points[0], points[1], points[2], points[3]);
    EXPECT_LE(computed, sampled + 1e-9) << "seed 61, round " << round;
    EXPECT_GE(computed, sampled - 0.06) << "seed 61, round " << round;
  }
}

TEST(TriangleTree, FindsTheNearestOfAllTriangles) {
  std::mt19937 random(test::seed(62));
  std::uniform_real_distribution<double> place(-14.0, 14.0);
  for (const int triangles : {1, 2, 4, 5, 37, 900}) {
    const TriangleMesh mesh = soup(random, triangles);
    const TriangleTree tree(mesh);
    for (int round = 0; round < 200; ++round) {
      const Vec3 p(place(random), place(random), place(random));
      double nearest = 1e300;
      for (const auto& t : mesh.triangles)
        nearest = std::min(nearest, triangle_distance_mm(p, mesh.vertices_mm[t[0]].cast<double>(),
                                                         mesh.vertices_mm[t[1]].cast<double>(),
                                                         mesh.vertices_mm[t[2]].cast<double>()));
      EXPECT_NEAR(tree.distance_mm(p, 100.0), nearest, 1e-9) << "seed 62, " << triangles << " triangles";
      EXPECT_NEAR(tree.distance_mm(p, 1.5), std::min(nearest, 1.5), 1e-9);
    }
  }
}

TEST(TriangleTree, KnowsOnlyTrianglesThatTouchItsBox) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 9}, {1, 0, 9}, {0, 1, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const Aabb box{Vec3(-1, -1, -1), Vec3(2, 2, 2)};
  const TriangleTree tree(mesh, &box);
  EXPECT_DOUBLE_EQ(tree.distance_mm(Vec3(0.2, 0.2, 8.0), 100.0), 8.0);
  const TriangleTree none(TriangleMesh{});
  EXPECT_TRUE(none.empty());
  EXPECT_DOUBLE_EQ(none.distance_mm(Vec3::Zero(), 7.0), 7.0);
}

}  // namespace
}  // namespace ream
