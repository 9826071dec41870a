#include "surface/removed_share.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "voxel/bone_model.hpp"

namespace ream::surface {
namespace {

/// A block whose top lies at that height in voxels, with a ramp of one voxel.
std::vector<uint8_t> level_top(const voxel::VoxelGrid& grid, double height) {
  std::vector<uint8_t> coverage(grid.voxel_count());
  for (size_t i = 0; i < coverage.size(); ++i) {
    const double above = grid.coordinates(i).z() + 0.5 - height;
    coverage[i] = static_cast<uint8_t>(std::lround(255.0 * std::clamp(0.5 - above, 0.0, 1.0)));
  }
  return coverage;
}

voxel::VoxelGrid small_grid() {
  voxel::VoxelGrid grid;
  grid.dims = {16, 16, 16};
  grid.spacing_mm = {0.5, 0.4, 0.25};
  return grid;
}

TEST(RemovedShare, GrowsWithDepthFromNoneToWholeOnThePresentSurface) {
  const voxel::VoxelGrid grid = small_grid();
  const std::vector<uint8_t> before = level_top(grid, 9.0);
  float last = 0.0f;
  for (const double depth : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.5}) {
    const std::vector<uint8_t> now = level_top(grid, 9.0 - depth);
    const TriangleMesh surface = whole_surface(grid, now.data());
    const std::vector<float> shares = removed_shares(surface.vertices_mm, grid, before.data(), now.data());
    float top = 0.0f;
    for (size_t i = 0; i < shares.size(); ++i) {
      const Vec3f& vertex = surface.vertices_mm[i];
      const bool in_middle = std::abs(vertex.x() - 4.0f) < 1.0f && std::abs(vertex.y() - 3.2f) < 1.0f;
      if (in_middle && vertex.z() > 1.0f) top = std::max(top, shares[i]);
      if (vertex.z() < 1.0f) {
        EXPECT_EQ(shares[i], 0.0f) << "of sides and bottom nothing is gone";
      }
    }
    const bool grows = depth > 0.0 && depth <= 0.5;
    EXPECT_TRUE(grows ? top > last : top >= last) << depth;
    EXPECT_TRUE(depth > 0.0 || top == 0.0f);
    EXPECT_TRUE(depth < 1.0 || top == 1.0f) << depth;
    last = top;
  }
}

TEST(RemovedShare, IsWholeFromHalfAVoxelOnAndNoneWhereNothingIsGone) {
  const voxel::VoxelGrid grid = small_grid();
  const std::vector<uint8_t> before = level_top(grid, 9.0), now = level_top(grid, 5.0);
  const auto at = [](double x, double z) {
    return Vec3f(static_cast<float>(x), 3.2f, static_cast<float>(z));
  };
  EXPECT_EQ(removed_shares(std::vector{at(4, 5 * 0.25)}, grid, before.data(), now.data())[0], 1.0f);
  // In whole bone a place lies deep, and yet nothing is gone there; beyond the grid there was nothing.
  EXPECT_EQ(
      removed_shares(std::vector{at(4, 2 * 0.25), at(4, -9), at(-3, 1)}, grid, before.data(), now.data()),
      (std::vector<float>{0, 0, 0}));
  EXPECT_EQ(removed_shares(std::vector{at(4, 9 * 0.25)}, grid, before.data(), before.data())[0], 0.0f);
}

}  // namespace
}  // namespace ream::surface
