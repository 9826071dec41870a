#pragma once
#include <cstdint>

#include "voxel/voxel_grid.hpp"

namespace ream::surface {

/// Edge of a surface block in voxels (4 bricks).
inline constexpr int block_edge = 32;

/// How a grid is divided into surface blocks, numbered x + bx * (y + by * z); the last ones may stick out of
/// the grid.
struct BlockLayout {
  explicit BlockLayout(const voxel::VoxelGrid& grid);

  uint32_t count() const { return static_cast<uint32_t>(block_dims.prod()); }
  Vec3i coordinates(uint32_t block) const;
  uint32_t index(const Vec3i& block) const {
    return static_cast<uint32_t>(block.x() + block_dims.x() * (block.y() + block_dims.y() * block.z()));
  }

  Vec3i block_dims, grid_dims;
};

/// Blocks first..last along each axis.
struct BlockRange {
  Vec3i first, last;
};

/// Samples of coverage, one every `stride` voxels, that a block's surface depends on beyond its own: cells
/// and gradients reach two out; coarse samples look at their neighbours as well (coarse.hpp).
constexpr int reach_voxels(int stride) { return stride == 1 ? 2 : 3 * stride; }

/// Blocks whose surface at that stride may change with the coverage of the voxels low to high.
BlockRange blocks_touched(const BlockLayout& layout, const Vec3i& low, const Vec3i& high, int stride);

template <typename Visit>
void for_each_block(const BlockLayout& layout, const BlockRange& range, Visit visit) {
  for (int z = range.first.z(); z <= range.last.z(); ++z)
    for (int y = range.first.y(); y <= range.last.y(); ++y)
      for (int x = range.first.x(); x <= range.last.x(); ++x) visit(layout.index({x, y, z}));
}

}  // namespace ream::surface
