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
/// and gradients reach two out; coarse samples look at their neighbours as well (coarse_samples()).
constexpr int reach_voxels(int stride) { return stride == 1 ? 2 : 3 * stride; }

/// Blocks whose surface at that stride may change with the coverage of the voxels low to high.
BlockRange blocks_touched(const BlockLayout& layout, const Vec3i& low, const Vec3i& high, int stride);

template <typename Visit>
void for_each_block(const BlockLayout& layout, const BlockRange& range, Visit visit) {
  for (int z = range.first.z(); z <= range.last.z(); ++z)
    for (int y = range.first.y(); y <= range.last.y(); ++y)
      for (int x = range.first.x(); x <= range.last.x(); ++x) visit(layout.index({x, y, z}));
}

/// Which voxels of a brick are filled (coverage of 128 or more).
enum class Fill : uint8_t { none, all, some };

/// `brick` has brick_voxels bytes.
Fill fill_of(const uint8_t* brick);

/// False only where the block cannot hold a surface, at any stride: its bricks and those after it, whose
/// first voxels its cells reach, are all empty or all full; outside the grid is empty. `fill_at` gives the
/// Fill of a brick by its number, and is not asked further than needed.
template <typename FillAt>
bool may_hold_surface(const voxel::VoxelGrid& grid, const Vec3i& block, FillAt fill_at) {
  constexpr int edge = block_edge / voxel::brick_edge;
  const Vec3i low = block * edge, high = low.array() + edge, dims = grid.brick_dims();
  const bool at_border = (low.array() == 0).any() || (high.array() >= dims.array()).any();
  const Vec3i last = high.cwiseMin(dims - Vec3i::Ones());
  const Fill first = at_border ? Fill::none : fill_at(grid.brick_index(low));
  for (int z = low.z(); z <= last.z(); ++z)
    for (int y = low.y(); y <= last.y(); ++y)
      for (int x = low.x(); x <= last.x(); ++x) {
        const Fill fill = fill_at(grid.brick_index({x, y, z}));
        if (fill == Fill::some || fill != first) return true;
      }
  return false;
}

}  // namespace ream::surface
