#pragma once
#include <cstdint>
#include <vector>

#include "voxel/bone_model.hpp"

namespace ream::voxel {

/// Conservative distance to bone, in bricks: for each brick the Chebyshev distance to the nearest brick that
/// holds any coverage, at most 255. Removal is monotone, so the field stays a valid lower bound for the whole
/// session and is built once.
struct BrickDistance {
  Vec3i brick_dims;
  std::vector<uint8_t> bricks;  ///< x fastest

  /// Lower bound, in voxels, of the Chebyshev distance from a point (voxel coordinates, may lie outside the
  /// grid) to the nearest voxel with coverage.
  float lower_bound_voxels(float x, float y, float z) const noexcept;
};

BrickDistance brick_distance(const BoneModel& bone);

}  // namespace ream::voxel
