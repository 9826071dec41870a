#include "fe/voxel_mask.hpp"

namespace ream::fe {
namespace {

constexpr int voxels_per_slab = 1 << 16;

int rows_per_slab(const VoxelMask& mask) {
  return std::clamp(voxels_per_slab / mask.dims().x(), 1, mask.dims().y() + 1);
}

}  // namespace

VoxelMask::VoxelMask(const Vec3i& dims)
    : dims_(dims),
      words_per_row_(static_cast<size_t>(dims.x()) / 64 + 1),
      words_(bytes_of(dims) / sizeof(uint64_t)) {}

size_t VoxelMask::count() const { return set_bits(words_.data(), words_.size()); }

size_t VoxelMask::bytes_of(const Vec3i& dims) {
  return (static_cast<size_t>(dims.x()) / 64 + 1) * static_cast<size_t>(dims.y()) *
         static_cast<size_t>(dims.z()) * sizeof(uint64_t);
}

Slabs voxel_slabs(const VoxelMask& mask) { return {mask.dims().y(), mask.dims().z(), rows_per_slab(mask)}; }

Slabs corner_slabs(const VoxelMask& mask) {
  return {mask.dims().y() + 1, mask.dims().z() + 1, rows_per_slab(mask)};
}

}  // namespace ream::fe
