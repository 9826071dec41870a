#pragma once
#include <cstdint>
#include <vector>

#include "voxel/bone_model.hpp"

namespace ream::voxel {

/// Edge of an occupancy cell in voxels; a divisor of brick_edge.
inline constexpr int occupancy_edge = 4;

/// One bit per 4^3 voxels: set where any coverage was above zero when it was built. Small enough for the
/// processor's cache, so that points in the air are told without touching the grid. Removal is monotone: a
/// clear bit stays true.
struct Occupancy {
  Vec3i dims = Vec3i::Zero();   ///< in cells
  std::vector<uint32_t> words;  ///< cell index x fastest; bit i % 32 of word i / 32

  bool any(int x, int y, int z) const noexcept {
    const auto i = static_cast<uint32_t>(x + dims.x() * (y + dims.y() * z));
    return (words[i / 32] >> (i % 32)) & 1u;
  }
};

Occupancy occupancy(const BoneModel& bone);

}  // namespace ream::voxel
