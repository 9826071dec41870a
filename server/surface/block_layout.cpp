#include "surface/block_layout.hpp"

#include "core/vector_clones.hpp"

namespace ream::surface {

BlockLayout::BlockLayout(const voxel::VoxelGrid& grid)
    : block_dims((grid.dims.array() + (block_edge - 1)).matrix() / block_edge), grid_dims(grid.dims) {}

Vec3i BlockLayout::coordinates(uint32_t block) const {
  const int i = static_cast<int>(block);
  return {i % block_dims.x(), (i / block_dims.x()) % block_dims.y(), i / (block_dims.x() * block_dims.y())};
}

BlockRange blocks_touched(const BlockLayout& layout, const Vec3i& low, const Vec3i& high, int stride) {
  const int reach = reach_voxels(stride);
  const auto block_of = [&](const Vec3i& voxel) -> Vec3i {
    return voxel.cwiseMax(0).cwiseMin(layout.grid_dims - Vec3i::Ones()) / block_edge;
  };
  return {block_of(low.array() - reach), block_of(high.array() + reach)};
}

REAM_VECTOR_CLONES Fill fill_of(const uint8_t* brick) {
  uint8_t any = 0, all = 0xff;
  for (int i = 0; i < voxel::brick_voxels; ++i) {
    any |= brick[i];
    all &= brick[i];
  }
  return (any & 0x80) == 0 ? Fill::none : (all & 0x80) != 0 ? Fill::all : Fill::some;
}

}  // namespace ream::surface
