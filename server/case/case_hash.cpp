#include <bit>
#include <span>

#include "case/case.hpp"
#include "core/hash.hpp"

namespace ream::case_ {
namespace {

void fold(uint64_t& rolling, double value) {
  rolling = hash_combine(rolling, std::bit_cast<uint64_t>(value));
}

}  // namespace

uint64_t case_hash(const Case& c) {
  const voxel::VoxelGrid& grid = c.bone.grid;
  uint64_t rolling = 0;
  for (int axis = 0; axis < 3; ++axis) {
    rolling = hash_combine(rolling, static_cast<uint64_t>(grid.dims[axis]));
    fold(rolling, grid.spacing_mm[axis]);
    fold(rolling, grid.world_from_grid.translation_mm[axis]);
    for (int column = 0; column < 3; ++column) fold(rolling, grid.world_from_grid.rotation(axis, column));
  }
  fold(rolling, c.bone.cortical_threshold_g_cc);
  rolling = hash_bytes(std::as_bytes(std::span(c.bone.density)), rolling);
  return hash_bytes(std::as_bytes(std::span(c.bone.coverage)), rolling);
}

}  // namespace ream::case_
