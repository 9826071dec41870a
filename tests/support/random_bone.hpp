#pragma once
#include <random>

#include "voxel/bone_model.hpp"

namespace ream::test {

inline voxel::VoxelGrid grid_of(const Vec3i& dims, const Vec3& spacing_mm = Vec3::Ones()) {
  voxel::VoxelGrid grid;
  grid.dims = dims;
  grid.spacing_mm = spacing_mm;
  return grid;
}

/// Bone in which a share of the voxels, evenly spread, has random coverage above 0 and random density.
inline voxel::BoneModel random_bone(std::mt19937& random, const Vec3i& dims, double filled_share) {
  voxel::BoneModel bone = voxel::make_bone(grid_of(dims));
  std::bernoulli_distribution filled(filled_share);
  std::uniform_int_distribution<int> coverage(1, 255), density(0, voxel::max_density_code);
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    if (!filled(random)) continue;
    bone.coverage[i] = static_cast<uint8_t>(coverage(random));
    bone.density.writable()[i] = static_cast<uint8_t>(density(random));
  }
  return bone;
}

}  // namespace ream::test
