#include "surface/block_mesh.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>

#include "core/units.hpp"
#include "support/seed.hpp"
#include "surface/marching_cubes.hpp"
#include "unit/surface/volumes.hpp"

namespace ream::surface {
namespace {

using Position = std::array<int, 3>;  // 1/1024 voxel in the grid
using Triangle = std::array<Position, 3>;

Triangle rotated_to_smallest_first(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// The plainest form of the same surface: cell by cell over the whole grid, without blocks, bits or shared
/// vertices.
std::vector<Triangle> reference_triangles(const voxel::VoxelGrid& grid,
                                          const std::vector<uint8_t>& coverage) {
  const auto at = [&](const Vec3i& o) { return grid.contains(o) ? int{coverage[grid.index(o)]} : 0; };
  std::vector<Triangle> result;
  for (int z = -1; z < grid.dims.z(); ++z)
    for (int y = -1; y < grid.dims.y(); ++y)
      for (int x = -1; x < grid.dims.x(); ++x) {
        size_t filled = 0;
        for (int c = 0; c < 8; ++c)
          if (at(Vec3i(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2 & 1))) > 127) filled |= size_t{1} << c;
        const CellCase& cell = cell_cases()[filled];
        for (size_t t = 0; t < cell.triangle_count; ++t) {
          Triangle triangle;
          for (size_t i = 0; i < 3; ++i) {
            const CellEdge e = cell_edge(cell.triangles[t][i]);
            const Vec3i lower(x + e.lower_corner[0], y + e.lower_corner[1], z + e.lower_corner[2]);
            const int a = at(lower), b = at(lower + Vec3i::Unit(e.axis));
            for (int k = 0; k < 3; ++k) triangle[i][static_cast<size_t>(k)] = 1024 * lower[k] + 512;
            triangle[i][static_cast<size_t>(e.axis)] +=
                static_cast<int>(std::lround(1024 * (127.5 - a) / (b - a)));
          }
          result.push_back(rotated_to_smallest_first(triangle));
        }
      }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Triangle> block_triangles(const voxel::VoxelGrid& grid, const std::vector<uint8_t>& coverage) {
  BlockExtractor extractor(grid);
  std::vector<Triangle> result;
  for (uint32_t block = 0; block < extractor.layout().count(); ++block) {
    const BlockMesh mesh = extractor.extract(coverage.data(), block);
    const Vec3i origin = ((extractor.layout().coordinates(block) * block_edge).array() - 1) * units_per_voxel;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      Triangle t;
      for (size_t k = 0; k < 3; ++k) {
        const BlockVertex& v = mesh.vertices[mesh.indices[i + k]];
        t[k] = {origin.x() + v.x, origin.y() + v.y, origin.z() + v.z};
      }
      result.push_back(rotated_to_smallest_first(t));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(BlockMesh, UnionOfBlocksIsTheSurfaceOfTheWholeGrid) {
  const unsigned seed = test::seed();
  for (unsigned i = 0; i < 6; ++i) {
    const voxel::VoxelGrid grid = grid_of(i % 2 == 0 ? Vec3i(40, 64, 72) : Vec3i(96, 32, 8));
    const std::vector<uint8_t> coverage = noise(grid, seed + i);
    EXPECT_TRUE(block_triangles(grid, coverage) == reference_triangles(grid, coverage))
        << "seed " << seed + i;
  }
}

TEST(BlockMesh, FullGridIsClosedAtItsBorders) {
  const voxel::VoxelGrid grid = grid_of({32, 40, 64});
  const std::vector<uint8_t> coverage(grid.voxel_count(), 255);
  const std::vector<Triangle> triangles = block_triangles(grid, coverage);
  EXPECT_TRUE(triangles == reference_triangles(grid, coverage));
  Position low = triangles[0][0], high = low;
  for (const Triangle& t : triangles)
    for (const Position& p : t)
      for (size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  EXPECT_EQ(low, (Position{0, 0, 0}));
  EXPECT_EQ(high, (Position{32 * 1024, 40 * 1024, 64 * 1024}));
}

TEST(BlockMesh, NeighboursAgreeOnSharedVerticesAndNormals) {
  const voxel::VoxelGrid grid = grid_of({96, 64, 64}, {0.5, 0.6, 0.7});
  const std::vector<uint8_t> coverage = noise(grid, test::seed());
  BlockExtractor extractor(grid);
  std::map<Position, std::pair<int8_t, int8_t>> normals;
  size_t shared = 0;
  for (uint32_t block = 0; block < extractor.layout().count(); ++block) {
    const Vec3i origin = ((extractor.layout().coordinates(block) * block_edge).array() - 1) * units_per_voxel;
    for (const BlockVertex& v : extractor.extract(coverage.data(), block).vertices) {
      const auto [place, fresh] =
          normals.try_emplace({origin.x() + v.x, origin.y() + v.y, origin.z() + v.z}, v.ox, v.oy);
      shared += !fresh;
      EXPECT_EQ(place->second, std::make_pair(v.ox, v.oy));
    }
  }
  EXPECT_GT(shared, 0u);
}

TEST(BlockMesh, NoDegenerateTrianglesAndEveryVertexUsedInNoise) {
  const voxel::VoxelGrid grid = grid_of({64, 32, 32});
  const std::vector<uint8_t> coverage = noise(grid, test::seed());
  BlockExtractor extractor(grid);
  for (uint32_t block = 0; block < extractor.layout().count(); ++block) {
    const BlockMesh mesh = extractor.extract(coverage.data(), block);
    std::vector<bool> used(mesh.vertices.size());
    const auto at = [&](size_t i) {
      used[mesh.indices[i]] = true;
      const BlockVertex& v = mesh.vertices[mesh.indices[i]];
      return Eigen::Matrix<int64_t, 3, 1>(v.x, v.y, v.z);
    };
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto a = at(i), b = at(i + 1), c = at(i + 2);
      ASSERT_FALSE((b - a).cross(c - a).isZero());
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
  }
}

TEST(BlockMesh, EmptyAndFullBlocksHoldNothing) {
  const voxel::VoxelGrid grid = grid_of({96, 96, 96});
  BlockExtractor extractor(grid);
  const uint32_t middle = 1 + 3 * (1 + 3 * 1);
  EXPECT_TRUE(extractor.extract(std::vector<uint8_t>(grid.voxel_count(), 0).data(), middle).vertices.empty());
  EXPECT_TRUE(
      extractor.extract(std::vector<uint8_t>(grid.voxel_count(), 255).data(), middle).indices.empty());
}

TEST(BlockMesh, NormalsOfASphereArePointingOutwardsWithinTwoDegrees) {
  // Unequal spacing: the normal must be that of millimetres. 2 degrees hold the 8-bit octahedral map (below
  // 1) and the central differences of a coverage that is one voxel steep.
  const Vec3 spacing_mm(0.5, 0.6, 0.7), centre_mm(15.1, 16.2, 16.9);
  const voxel::VoxelGrid grid = grid_of({64, 64, 64}, spacing_mm);
  const auto coverage =
      coverage_of(grid, [&](const Vec3& p) { return 0.25 * (12.0 - (p - centre_mm).norm()); });
  BlockExtractor extractor(grid);
  double worst_rad = 0;
  size_t count = 0;
  for (uint32_t block = 0; block < extractor.layout().count(); ++block)
    for (const BlockVertex& v : extractor.extract(coverage.data(), block).vertices) {
      const Vec3 p = position_mm(v, extractor.layout().coordinates(block), spacing_mm).cast<double>();
      const Vec3 n = direction_from_octahedral(v.ox, v.oy).cast<double>();
      EXPECT_NEAR((p - centre_mm).norm(), 12.0, 0.02);
      worst_rad = std::max(worst_rad, std::acos(std::min(1.0, n.dot((p - centre_mm).normalized()))));
      ++count;
    }
  EXPECT_GT(count, 5000u);
  EXPECT_LT(degrees_from_radians(worst_rad), 2.0);
}

TEST(Octahedral, ComesBackWithinOneDegree) {
  std::mt19937 random(test::seed(7));
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20000; ++i) {
    const Vec3f n = Vec3f(normal(random), normal(random), normal(random)).normalized();
    const auto o = octahedral_from_direction(n);
    EXPECT_GT(n.dot(direction_from_octahedral(o[0], o[1])), std::cos(radians_from_degrees(1.0)));
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      const auto o = octahedral_from_direction(sign * 3.0f * Vec3f::Unit(axis));
      EXPECT_LT((direction_from_octahedral(o[0], o[1]) - sign * Vec3f::Unit(axis)).norm(), 1e-6f);
    }
}

}  // namespace
}  // namespace ream::surface
