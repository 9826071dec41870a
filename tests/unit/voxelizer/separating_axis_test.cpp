#include "support/separating_axis.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <iostream>
#include <map>

#include "geometry/mesh_io.hpp"
#include "support/awkward_triangles.hpp"
#include "support/shared_data.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::voxelizer {
namespace {

using test::TriangleAxes;

/// What the issue allows, voxels.
constexpr double farthest = 1e-5;

RasterGrid unit_grid(const Vec3i& dims) { return {dims, Vec3::Zero(), Vec3::Ones()}; }

TriangleMesh mesh_of(const std::array<Vec3f, 3>& corners) {
  TriangleMesh mesh;
  mesh.vertices_mm.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

VoxelSet marked(Voxelizer& voxelizer, const TriangleMesh& mesh, const RasterGrid& grid,
                Separability separability) {
  VoxelSet set(grid);
  Request request;
  request.separability = separability;
  voxelizer.voxelize(mesh, request, set);
  return set;
}

bool bit(const VoxelSet& set, int u, int v, int w) {
  const size_t row =
      static_cast<size_t>(v) + static_cast<size_t>(set.grid().dims.y()) * static_cast<size_t>(w);
  return ((set.words()[row * set.grid().words_per_row() + static_cast<size_t>(u / 32)] >> (u % 32)) & 1u) !=
         0;
}

TEST(SeparatingAxis, TenThousandAwkwardTrianglesMarkTheirSupercover) {
  constexpr unsigned seed = 20261122;
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  Voxelizer voxelizer(1);
  const RasterGrid grid = unit_grid({31, 26, 22});
  std::map<std::string, std::pair<int, int>> wrong;  // missed, added
  uint64_t voxels = 0;
  for (int number = 0; number < 10000; ++number) {
    const test::AwkwardTriangle triangle = test::awkward_triangle(random, number, grid.dims);
    const TriangleMesh mesh = mesh_of(triangle.corners);
    const VoxelSet thick = marked(voxelizer, mesh, grid, Separability::twenty_six);
    const VoxelSet thin = marked(voxelizer, mesh, grid, Separability::six);
    for (size_t i = 0; i < thick.word_count(); ++i)
      ASSERT_EQ(thin.words()[i] & ~thick.words()[i], 0u) << triangle.kind << ' ' << number;
    std::array<Vec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = triangle.corners[i].cast<double>();
    const TriangleAxes axes(corners);
    auto& [missed, added] = wrong[triangle.kind];
    for (int w = 0; w < grid.dims.z(); ++w)
      for (int v = 0; v < grid.dims.y(); ++v)
        for (int u = 0; u < grid.dims.x(); ++u) {
          const double gap = axes.gap({u + 0.5, v + 0.5, w + 0.5}, farthest);
          const bool is_marked = bit(thick, u, v, w);
          voxels += is_marked;
          missed += !is_marked && gap <= 0.0;
          added += is_marked && gap > farthest;
        }
  }
  EXPECT_GT(voxels, 150000u);
  for (const auto& [kind, counts] : wrong) {
    EXPECT_EQ(counts.first, 0) << "missed by kind: " << kind;
    EXPECT_EQ(counts.second, 0) << "added by kind: " << kind;
  }
}

}  // namespace
}  // namespace ream::voxelizer
