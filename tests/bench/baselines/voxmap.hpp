#pragma once
#include <cstdint>
#include <vector>

#include "geometry/box.hpp"
#include "voxel/bone_model.hpp"

namespace ream::bench {

/// Bone as the thesis stores it (section 4.2): one byte a voxel in the row order of eq. 4.1, 0 void, else the
/// gray value. The baselines work on this copy, never on the product's arrays.
struct Voxmap {
  Vec3i dims = Vec3i::Zero();
  Vec3 spacing_mm = Vec3::Ones();
  std::vector<uint8_t> gray;
  Aabb bone_box_mm;  ///< around all filled voxels, grid frame; empty without any

  voxel::VoxelGrid grid() const;
};

/// Voxels with at least half coverage are filled; their gray value is the density code, at least 1.
Voxmap voxmap_of(const voxel::BoneModel& bone);

}  // namespace ream::bench
