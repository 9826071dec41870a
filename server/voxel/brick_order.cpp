#include "voxel/brick_order.hpp"

#include <cassert>
#include <cstring>

namespace ream::voxel {
namespace {

/// Calls visit(place in brick order, place in row order) for every run of brick_edge voxels along x.
template <typename Visit>
void each_run(const VoxelGrid& grid, Visit visit) {
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); u += brick_edge) visit(grid.index(u, v, w), grid.row_index(u, v, w));
}

}  // namespace

std::vector<uint8_t> bricks_from_rows(const VoxelGrid& grid, std::span<const uint8_t> rows) {
  assert(rows.size() == grid.voxel_count());
  std::vector<uint8_t> bricks(rows.size());
  each_run(grid, [&](size_t brick, size_t row) { std::memcpy(&bricks[brick], &rows[row], brick_edge); });
  return bricks;
}

std::vector<uint8_t> rows_from_bricks(const VoxelGrid& grid, std::span<const uint8_t> bricks) {
  assert(bricks.size() == grid.voxel_count());
  std::vector<uint8_t> rows(bricks.size());
  each_run(grid, [&](size_t brick, size_t row) { std::memcpy(&rows[row], &bricks[brick], brick_edge); });
  return rows;
}

}  // namespace ream::voxel
