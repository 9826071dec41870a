#pragma once
#include <cstddef>
#include <string>

namespace ream::collide {

/// How a bone's bytes, one a voxel, are laid out in a device's buffers: part p has the voxels from p << shift
/// on, in the order of VoxelGrid::index, at most 1 << shift of them. Parts are whole bricks.
struct BoneParts {
  int count = 1;  ///< 1 to 4 that hold voxels
  int shift = 0;  ///< 0 where there is one part only

  /// Numbers of parts that kernels are built for: 1, 2 or 4; where three hold voxels the fourth is there but
  /// empty.
  int built() const { return count == 3 ? 4 : count; }
  /// Compiler options for the kernels that include kernels/bone_parts.h, like " -D PARTS=2 -D PART_SHIFT=30".
  std::string build_options() const;
};

/// The fewest parts that fit a device: one where `largest_buffer_bytes` (the largest it allocates at once)
/// allows, else as many as are needed of the largest power of two below it. Throws Error unavailable, naming
/// the device, where four are not enough.
BoneParts bone_parts(size_t voxels, size_t largest_buffer_bytes, const std::string& device_name);

}  // namespace ream::collide
