#pragma once
#include <cstdint>
#include <vector>

#include "voxel/bone_model.hpp"

namespace ream::voxel {

/// Conservative distance to bone, in bricks: for each brick the Chebyshev distance to the nearest brick that
/// holds a solid voxel, at most 255. Removal is monotone, so the field stays a valid lower bound for the
/// whole session and is built once.
struct BrickDistance {
  Vec3i brick_dims;
  std::vector<uint8_t> bricks;  ///< x fastest; rounded up to whole words of four

  /// Lower bound, in voxels, of the Chebyshev distance from a point (voxel coordinates, may lie outside the
  /// grid) to the nearest solid voxel.
  float lower_bound_voxels(float x, float y, float z) const noexcept;
  /// True when no voxel was solid.
  bool nothing() const noexcept;
};

BrickDistance brick_distance(const BoneModel& bone);

}  // namespace ream::voxel
