#include "support/separating_axis.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <iostream>
#include <map>

#include "geometry/mesh_io.hpp"
#include "support/awkward_triangles.hpp"
#include "support/seed.hpp"
#include "support/shared_data.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::voxelizer {
namespace {

using test::TriangleAxes;

/// What the issue allows, voxels.
constexpr double max_gap = 1e-5;

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

TEST(SeparatingAxis, TwentyThousandAwkwardTrianglesMarkTheirSupercover) {
  const uint32_t seed = test::seed(20261122);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  Voxelizer voxelizer(1);
  // Rows of one word and of three: small triangles in rows of several words are marked eight at a time.
  const RasterGrid grids[] = {unit_grid({31, 26, 22}), unit_grid({70, 24, 21})};
  std::map<std::string, std::pair<int, int>> wrong;  // missed, added
  uint64_t voxels = 0;
  for (int number = 0; number < 20000; ++number) {
    const RasterGrid& grid = grids[number < 10000];
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
          const double gap = axes.gap({u + 0.5, v + 0.5, w + 0.5}, max_gap);
          const bool is_marked = bit(thick, u, v, w);
          voxels += is_marked;
          missed += !is_marked && gap <= 0.0;
          added += is_marked && gap > max_gap;
        }
  }
  EXPECT_GT(voxels, 150000u);
  for (const auto& [kind, counts] : wrong) {
    EXPECT_EQ(counts.first, 0) << "missed by kind: " << kind;
    EXPECT_EQ(counts.second, 0) << "added by kind: " << kind;
  }
}

/// Triangles are marked eight at a time, with others of their size: none may touch what is another's.
TEST(SeparatingAxis, ManyTrianglesMarkWhatEachMarksAlone) {
  const uint32_t seed = test::seed(4711);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  Voxelizer voxelizer(2);
  const RasterGrid grid = unit_grid({90, 50, 70});
  for (int soup = 0; soup < 20; ++soup) {
    TriangleMesh mesh;
    VoxelSet together(grid);
    std::vector<uint32_t> alone(together.word_count(), 0);
    for (int number = 0; number < 150; ++number) {
      const test::AwkwardTriangle triangle = test::awkward_triangle(random, number, grid.dims);
      const VoxelSet one = marked(voxelizer, mesh_of(triangle.corners), grid, Separability::twenty_six);
      for (size_t i = 0; i < alone.size(); ++i) alone[i] |= one.words()[i];
      const auto first = static_cast<uint32_t>(mesh.vertices_mm.size());
      for (const Vec3f& corner : triangle.corners) mesh.vertices_mm.push_back(corner);
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    voxelizer.voxelize(mesh, {}, together);
    for (size_t i = 0; i < alone.size(); ++i) ASSERT_EQ(together.words()[i], alone[i]) << soup << ' ' << i;
  }
}

}  // namespace
}  // namespace ream::voxelizer
