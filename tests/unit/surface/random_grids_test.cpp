#include <gtest/gtest.h>

#include <iostream>
#include <unordered_map>

#include "support/seed.hpp"
#include "surface/block_mesh.hpp"
#include "unit/surface/volumes.hpp"

namespace ream::surface {
namespace {

constexpr int grids = 1000;

/// A few random planes and balls cut by each other: smooth surfaces, edges, thin walls and gaps.
std::vector<uint8_t> shapes(const voxel::VoxelGrid& grid, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  struct Shape {
    Vec3 centre, axis;
    double size;
    bool ball;
  };
  std::vector<Shape> shapes(1 + random() % 4);
  const Vec3 extent = grid.bounds_mm().max;
  for (Shape& s : shapes) {
    s.centre = Vec3(unit(random), unit(random), unit(random)).cwiseProduct(extent);
    s.axis = Vec3(normal(random), normal(random), normal(random)).normalized();
    s.ball = random() % 2 == 0;
    s.size = s.ball ? unit(random) * 0.6 * extent.maxCoeff() : 0.3 + 3.0 * unit(random);
  }
  const bool hollow = random() % 2 == 0;
  return coverage_of(grid, [&](const Vec3& p) {
    double inside = -1e9;
    for (const Shape& s : shapes) {
      const Vec3 d = p - s.centre;
      const double here = s.size - (s.ball ? d.norm() : std::abs(d.dot(s.axis)));
      inside = hollow ? std::max(std::min(inside, -here), std::min(here, -inside)) : std::max(inside, here);
    }
    return inside;
  });
}

struct RandomGrid {
  voxel::VoxelGrid grid;
  std::vector<uint8_t> coverage;
};

RandomGrid random_grid(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> spacing(0.3, 1.2);
  const auto edge = [&](unsigned most) { return voxel::brick_edge * static_cast<int>(1 + random() % most); };
  Vec3i dims(8, edge(2), edge(2));
  std::shuffle(dims.data(), dims.data() + 3, random);
  dims[static_cast<int>(random() % 3)] = edge(9);  // up to three blocks in a row
  if (random() % 8 == 0) dims[static_cast<int>(random() % 3)] = edge(5);
  RandomGrid result{grid_of(dims, {spacing(random), spacing(random), spacing(random)}), {}};
  if (random() % 2 == 0) {
    result.coverage = noise(result.grid, static_cast<unsigned>(random()));
    const auto crisp = random() % 3 == 0;
    for (uint8_t& c : result.coverage)
      if (crisp) c = c < 128 ? 0 : 255;
  } else {
    result.coverage = shapes(result.grid, random);
  }
  return result;
}

/// The blocks' triangles, joined where positions are equal and nowhere else.
struct Joined {
  std::vector<std::array<uint32_t, 3>> triangles;
  size_t vertices = 0;
  bool normals_agree = true;
};

Joined joined(const RandomGrid& g, int stride) {
  Joined result;
  BlockExtractor extractor(g.grid, stride);
  std::unordered_map<uint64_t, std::pair<uint32_t, BlockVertex>> known;
  for (uint32_t block = 0; block < extractor.layout().count(); ++block) {
    const BlockMesh mesh = extractor.extract(g.coverage.data(), block);
    const Vec3i origin = extractor.layout().coordinates(block) * block_edge * units_per_voxel;
    std::vector<uint32_t> number;
    for (const BlockVertex& v : mesh.vertices) {
      const auto part = [&](int axis, uint16_t p) { return static_cast<uint64_t>(origin[axis] + p); };
      const uint64_t key = part(0, v.x) | part(1, v.y) << 21 | part(2, v.z) << 42;
      const auto [place, fresh] = known.try_emplace(key, static_cast<uint32_t>(known.size()), v);
      number.push_back(place->second.first);
      const BlockVertex& first = place->second.second;
      if (first.ox != v.ox || first.oy != v.oy) result.normals_agree = false;
    }
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
      result.triangles.push_back(
          {number[mesh.indices[i]], number[mesh.indices[i + 1]], number[mesh.indices[i + 2]]});
  }
  result.vertices = known.size();
  return result;
}

TEST(RandomGrids, SurfaceIsAClosedManifoldAtEveryStrideWithBordersEqualToTheBit) {
  const unsigned seed = test::seed();
  size_t triangles = 0;
  for (unsigned i = 0; i < grids && !HasFailure(); ++i) {
    const RandomGrid g = random_grid(seed + i);
    for (const int stride : {1, 2, 4}) {
      SCOPED_TRACE("seed " + std::to_string(seed + i) + ", stride " + std::to_string(stride));
      const Joined blocks = joined(g, stride);
      const Topology of_blocks = topology(blocks.vertices, blocks.triangles);
      EXPECT_TRUE(of_blocks.closed);
      EXPECT_TRUE(of_blocks.one_fan_per_vertex);
      EXPECT_TRUE(blocks.normals_agree);
      triangles += blocks.triangles.size();
      const TriangleMesh whole = whole_surface(g.grid, g.coverage.data(), 2, stride);
      const Topology of_whole = topology(whole.vertices_mm.size(), whole.triangles);
      EXPECT_TRUE(of_whole.closed);
      EXPECT_TRUE(of_whole.one_fan_per_vertex);
      EXPECT_EQ(whole.vertices_mm.size(), blocks.vertices);
      EXPECT_EQ(whole.triangles.size(), blocks.triangles.size());
      EXPECT_EQ(of_whole.euler, of_blocks.euler);
      EXPECT_GE(whole.volume_mm3(), 0.0);
    }
  }
  std::cout << triangles << " triangles\n";
  EXPECT_GT(triangles, 100000u);
}

}  // namespace
}  // namespace ream::surface
