#include "surface/block_volume.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "support/seed.hpp"
#include "surface/block_mesh.hpp"
#include "unit/surface/volumes.hpp"

namespace ream::surface {
namespace {

TEST(Coarse, SphereKeepsPlaceSizeAndShape) {
  const voxel::VoxelGrid grid = grid_of({72, 72, 72}, {0.5, 0.5, 0.5});
  const Vec3 centre(18.1, 17.8, 18.3);
  const double r = 14.0;
  const std::vector<uint8_t> coverage = sphere(grid, centre, r);
  const size_t fine = whole_surface(grid, coverage.data()).triangles.size();
  for (const int stride : {2, 4}) {
    const TriangleMesh mesh = whole_surface(grid, coverage.data(), 2, stride);
    const Topology t = topology(mesh.vertices_mm.size(), mesh.triangles);
    EXPECT_TRUE(t.closed && t.one_fan_per_vertex);
    EXPECT_EQ(t.euler, 2);
    EXPECT_NEAR(static_cast<double>(fine) / static_cast<double>(mesh.triangles.size()), stride * stride,
                0.15 * stride * stride);
    double worst_mm = 0.0;
    for (const Vec3f& p : mesh.vertices_mm)
      worst_mm = std::max(worst_mm, std::abs((p.cast<double>() - centre).norm() - r));
    // Means of a full ramp over one sample: within a quarter of a sample.
    EXPECT_LT(worst_mm, 0.25 * stride * 0.5) << stride;
    // Flat triangles inside a sphere of 28 / stride samples lose volume by the square of the sample.
    EXPECT_NEAR(mesh.volume_mm3() / (4.0 / 3.0 * pi * r * r * r), 1.0, 0.00125 * stride * stride) << stride;
  }
}

TEST(Coarse, AWallOfOneVoxelStaysWithoutHoles) {
  const voxel::VoxelGrid grid = grid_of({64, 64, 64});
  for (const int stride : {2, 4})
    for (int axis = 0; axis < 3; ++axis)
      for (int at = 29; at < 35; ++at) {
        std::vector<uint8_t> coverage(grid.voxel_count());
        for (size_t i = 0; i < coverage.size(); ++i)
          if (grid.coordinates(i)[axis] == at) coverage[i] = 255;
        const TriangleMesh mesh = whole_surface(grid, coverage.data(), 2, stride);
        EXPECT_EQ(topology(mesh.vertices_mm.size(), mesh.triangles).euler, 2) << stride << " " << axis;
        // A plate: both faces, 64 by 64.
        EXPECT_GT(area_mm2(mesh), 2 * 62.0 * 62.0) << stride << " " << axis << " " << at;
      }
}

TEST(Coarse, BesidePlaneSurfacesOfAnyTiltTheMeanIsEnough) {
  // So the thin walls' rule neither thickens nor roughens thick bone: the coarse volume is the fine one's.
  std::mt19937 random(test::seed());
  std::normal_distribution<double> normal;
  const voxel::VoxelGrid grid = grid_of({48, 48, 48});
  for (int i = 0; i < 20; ++i) {
    const Vec3 n = Vec3(normal(random), normal(random), normal(random)).normalized();
    const auto coverage = coverage_of(grid, [&](const Vec3& p) { return n.dot(Vec3(24, 24, 24) - p); });
    for (const int stride : {2, 4}) {
      const TriangleMesh mesh = whole_surface(grid, coverage.data(), 2, stride);
      for (const Vec3f& p : mesh.vertices_mm) {
        const Vec3 from_centre = p.cast<double>() - Vec3(24, 24, 24);
        if (from_centre.cwiseAbs().maxCoeff() > 24.0 - 2.0 * stride) continue;  // the grid's own sides
        EXPECT_LT(std::abs(n.dot(from_centre)), 0.3 * stride) << n.transpose() << ", stride " << stride;
      }
    }
  }
}

TEST(Coarse, RefusesOtherStrides) {
  const voxel::VoxelGrid grid = grid_of({32, 32, 32});
  const std::vector<uint8_t> coverage(grid.voxel_count());
  EXPECT_THROW(whole_surface(grid, coverage.data(), 1, 3), Error);
}

}  // namespace
}  // namespace ream::surface
