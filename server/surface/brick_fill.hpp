#pragma once
#include <cstdint>

#include "surface/block_layout.hpp"

namespace ream::surface {

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
