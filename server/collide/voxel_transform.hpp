#pragma once
#include <array>
#include <cstdint>

#include "geometry/pose.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::collide {

/// Takes the contact shell's places to voxels in whole numbers only, so that every device and compiler agrees
/// to the bit. A voxel coordinate is held in 2^-bits voxel; its voxel is that number shifted right by `bits`.
struct VoxelTransform {
  int bits = 0;
  std::array<int32_t, 9> per_unit{};  ///< row by row, each within 16 bits
  /// The same and the tool's origin in 2^-40 voxel, for the blocks' origins.
  std::array<int64_t, 9> fine{};
  std::array<int64_t, 3> origin_fine{};

  /// Coordinates of a block's origin in 2^-bits voxel. They fit 32 bits for blocks within 64 voxels of the
  /// grid.
  std::array<int32_t, 3> base(const Vec3i& origin_units) const noexcept;
};

/// Derived from the quantised pose in doubles, each number rounded once. `place_unit_mm` is the shell's.
VoxelTransform voxel_transform(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid,
                               double place_unit_mm) noexcept;

}  // namespace ream::collide
