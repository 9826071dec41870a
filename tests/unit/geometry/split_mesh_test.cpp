#include "geometry/split_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "support/seed.hpp"

namespace ream {
namespace {

double area_mm2(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.vertices_mm[b] - mesh.vertices_mm[a])
                     .cross(mesh.vertices_mm[c] - mesh.vertices_mm[a])
                     .cast<double>()
                     .norm();
  return sum;
}

/// A square of 20 mm in z = 0, facing up, of unequal triangles.
TriangleMesh sheet(std::mt19937_64& random) {
  constexpr uint32_t steps = 20;
  TriangleMesh mesh;
  const auto shaken = [&](uint32_t i) {
    const double by =
        i == 0 || i == steps ? 0.0 : 0.6 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
    return static_cast<float>(i + by);
  };
  for (uint32_t i = 0; i <= steps; ++i)
    for (uint32_t k = 0; k <= steps; ++k) {
      mesh.vertices_mm.emplace_back(shaken(i), shaken(k), 0.0f);
      mesh.normals.push_back(Vec3f::UnitZ());
    }
  for (uint32_t i = 0; i < steps; ++i)
    for (uint32_t k = 0; k < steps; ++k) {
      const uint32_t a = i * (steps + 1) + k, b = a + steps + 1;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b, b + 1, a + 1});
    }
  return mesh;
}

TEST(SplitMesh, FollowsAStraightLineExactlyAndLosesNothing) {
  const uint32_t seed = test::seed(8101);
  SCOPED_TRACE("random seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const TriangleMesh mesh = sheet(random);
  const Vec3f across = Vec3f(0.8f, 0.6f, 0.0f);
  std::vector<float> values;
  for (const Vec3f& vertex : mesh.vertices_mm) values.push_back(across.dot(vertex));
  for (const float level : {-1.0f, 3.3f, 12.25f, 27.9f, 40.0f}) {
    const SplitMesh parts = split_at(mesh, values, level);
    EXPECT_NEAR(area_mm2(parts.below) + area_mm2(parts.above), 400.0, 1e-3);
    for (const Vec3f& vertex : parts.below.vertices_mm) EXPECT_LT(across.dot(vertex), level + 1e-4f);
    for (const Vec3f& vertex : parts.above.vertices_mm) EXPECT_GT(across.dot(vertex), level - 1e-4f);
    for (const TriangleMesh* part : {&parts.below, &parts.above}) {
      EXPECT_EQ(part->normals.size(), part->vertices_mm.size());
      for (const auto& [a, b, c] : part->triangles) {
        ASSERT_LT(std::max({a, b, c}), part->vertices_mm.size());
        const Vec3f &p = part->vertices_mm[a], &q = part->vertices_mm[b], &r = part->vertices_mm[c];
        EXPECT_GE((q - p).cross(r - p).z(), -1e-6f) << "it was turned over";
      }
    }
  }
}

TEST(SplitMesh, NeighboursShareTheirCrossings) {
  std::mt19937_64 random(1);
  const TriangleMesh mesh = sheet(random);
  std::vector<float> values;
  for (const Vec3f& vertex : mesh.vertices_mm) values.push_back((vertex - Vec3f(10, 10, 0)).norm());
  const SplitMesh parts = split_at(mesh, values, 6.0f);
  // One piece without a hole: vertices less edges plus triangles.
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (const auto& t : parts.below.triangles)
    for (size_t i = 0; i < 3; ++i) edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  const auto euler = static_cast<int64_t>(parts.below.vertices_mm.size()) -
                     static_cast<int64_t>(edges.size()) + static_cast<int64_t>(parts.below.triangles.size());
  EXPECT_EQ(euler, 1);
  EXPECT_NEAR(area_mm2(parts.below), 3.14159265 * 36.0, 1.5);
}

TEST(SplitMesh, AMeshOfOneSideStaysWhole) {
  std::mt19937_64 random(2);
  const TriangleMesh mesh = sheet(random);
  const std::vector<float> values(mesh.vertices_mm.size(), 0.5f);
  EXPECT_TRUE(split_at(mesh, values, 0.6f).above.triangles.empty());
  EXPECT_EQ(split_at(mesh, values, 0.6f).below.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(split_at(mesh, values, 0.5f).above.triangles.size(), mesh.triangles.size());
}

}  // namespace
}  // namespace ream
