#include "surface/block_mesh.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "support/seed.hpp"
#include "unit/surface/volumes.hpp"

namespace ream::surface {
namespace {

TEST(WholeSurface, SphereIsClosedAndRound) {
  const voxel::VoxelGrid grid = grid_of({72, 72, 72}, {0.5, 0.5, 0.5});
  const double r = 14.0;
  const TriangleMesh mesh = whole_surface(grid, sphere(grid, {18.1, 17.8, 18.3}, r).data());
  const Topology t = topology(mesh.vertices_mm.size(), mesh.triangles);
  EXPECT_TRUE(t.closed);
  EXPECT_TRUE(t.one_fan_per_vertex);
  EXPECT_EQ(t.euler, 2);
  EXPECT_NEAR(mesh.volume_mm3() / (4.0 / 3.0 * pi * r * r * r), 1.0, 1e-3);
  // A ramp one voxel wide, cut off at 0 and 255, leaves the surface a little rough: 0.14 % more area.
  EXPECT_NEAR(area_mm2(mesh) / (4.0 * pi * r * r), 1.0, 2e-3);
  ASSERT_EQ(mesh.normals.size(), mesh.vertices_mm.size());
}

TEST(WholeSurface, UnequalSpacingKeepsMillimetres) {
  const voxel::VoxelGrid grid = grid_of({72, 56, 48}, {0.4, 0.5, 0.6});
  const double r = 12.0;
  const TriangleMesh mesh = whole_surface(grid, sphere(grid, {14.3, 14.0, 14.2}, r).data());
  EXPECT_NEAR(mesh.volume_mm3() / (4.0 / 3.0 * pi * r * r * r), 1.0, 2e-3);
}

TEST(WholeSurface, TouchingBlobsAreOneBodyAndApartTwo) {
  const voxel::VoxelGrid grid = grid_of({96, 48, 48});
  const auto blobs = [&](double distance) {
    const Vec3 a(24, 24, 24), b(24 + distance, 24, 24);
    const auto coverage = coverage_of(
        grid, [&](const Vec3& p) { return std::max(15.0 - (p - a).norm(), 15.0 - (p - b).norm()); });
    const TriangleMesh mesh = whole_surface(grid, coverage.data());
    const Topology t = topology(mesh.vertices_mm.size(), mesh.triangles);
    EXPECT_TRUE(t.closed && t.one_fan_per_vertex) << distance;
    return t.euler;
  };
  EXPECT_EQ(blobs(29.0), 2);
  EXPECT_EQ(blobs(33.0), 4);
  for (double distance = 29.5; distance < 31.5; distance += 0.25) blobs(distance);
}

TEST(WholeSurface, TorusHasAHole) {
  const voxel::VoxelGrid grid = grid_of({64, 64, 32});
  const auto coverage = coverage_of(grid, [](const Vec3& p) {
    const Vec3 d = p - Vec3(32, 32, 16);
    return 6.0 - std::hypot(std::hypot(d.x(), d.y()) - 18.0, d.z());
  });
  const TriangleMesh mesh = whole_surface(grid, coverage.data());
  EXPECT_EQ(topology(mesh.vertices_mm.size(), mesh.triangles).euler, 0);
  EXPECT_NEAR(mesh.volume_mm3() / (2 * pi * pi * 18.0 * 36.0), 1.0, 5e-3);
}

TEST(WholeSurface, AnyNoiseGivesAClosedManifold) {
  const unsigned seed = test::seed();
  for (unsigned i = 0; i < 8; ++i) {
    const voxel::VoxelGrid grid = grid_of({40, 48, 40});
    const TriangleMesh mesh = whole_surface(grid, noise(grid, seed + i).data());
    const Topology t = topology(mesh.vertices_mm.size(), mesh.triangles);
    EXPECT_TRUE(t.closed) << "seed " << seed + i;
    EXPECT_TRUE(t.one_fan_per_vertex) << "seed " << seed + i;
    EXPECT_GE(mesh.volume_mm3(), 0.0);
  }
}

TEST(WholeSurface, SameForAnyNumberOfThreads) {
  const voxel::VoxelGrid grid = grid_of({96, 72, 64});
  const std::vector<uint8_t> coverage = noise(grid, 3);
  const TriangleMesh one = whole_surface(grid, coverage.data(), 1),
                     four = whole_surface(grid, coverage.data(), 4);
  EXPECT_TRUE(one.vertices_mm == four.vertices_mm);
  EXPECT_TRUE(one.triangles == four.triangles);
  EXPECT_TRUE(one.normals == four.normals);
}

TEST(WholeSurface, EmptyGridGivesAnEmptyMeshAndAnImpossibleOneThrows) {
  const voxel::VoxelGrid grid = grid_of({32, 32, 32});
  EXPECT_TRUE(whole_surface(grid, std::vector<uint8_t>(grid.voxel_count()).data()).triangles.empty());
  EXPECT_THROW(whole_surface(grid_of({0, 8, 8}), nullptr), Error);
}

}  // namespace
}  // namespace ream::surface
