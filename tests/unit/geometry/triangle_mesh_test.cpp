#include "geometry/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream {
namespace {

/// Corner tetrahedron with legs a, b, c: volume a b c / 6.
TriangleMesh tetrahedron(float a, float b, float c) {
  return {{{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
}

TEST(TriangleMesh, VolumeIsThatOfTheTetrahedronWhereverItLies) {
  const uint32_t seed = test::seed(20264);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  const TriangleMesh mesh = tetrahedron(3, 4, 5);
  EXPECT_DOUBLE_EQ(mesh.volume_mm3(), 10.0);
  for (int i = 0; i < 50; ++i)
    EXPECT_NEAR(mesh.transformed(test::random_pose(random, 20.0)).volume_mm3(), 10.0, 2e-3);
}

TEST(TriangleMesh, VolumeIsNegativeWhenInsideOut) {
  TriangleMesh mesh = tetrahedron(3, 4, 5);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_DOUBLE_EQ(mesh.volume_mm3(), -10.0);
}

TEST(TriangleMesh, TransformTurnsNormalsButDoesNotMoveThem) {
  TriangleMesh mesh = tetrahedron(1, 1, 1);
  mesh.normals.assign(4, Vec3f::UnitX());
  const Pose a_from_b{test::rotation_about(Vec3::UnitZ(), 0.5 * pi), Vec3(10, 20, 30)};
  const TriangleMesh moved = mesh.transformed(a_from_b);
  EXPECT_LT((moved.vertices_mm[1] - Vec3f(10, 21, 30)).norm(), 1e-5f);
  for (const Vec3f& n : moved.normals) EXPECT_LT((n - Vec3f::UnitY()).norm(), 1e-6f);
  EXPECT_EQ(moved.triangles, mesh.triangles);
}

TEST(TriangleMesh, BoundsHoldAllVerticesAndNoMore) {
  const Aabb box = tetrahedron(3, 4, 5).bounds();
  EXPECT_EQ(box.min, Vec3(0, 0, 0));
  EXPECT_EQ(box.max, Vec3(3, 4, 5));
  EXPECT_TRUE(TriangleMesh{}.bounds().empty());
}

}  // namespace
}  // namespace ream
