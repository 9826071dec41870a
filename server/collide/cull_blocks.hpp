#pragma once
#include "collide/grid_affine.hpp"
#include "collide/narrow_phase.hpp"

namespace ream::collide {

/// How far the shell's blocks are from bone at one pose, by their spheres and the conservative distance.
class BoneGap {
 public:
  BoneGap(const voxel::BrickDistance& distance, const voxel::VoxelGrid& grid,
          const QuantisedPose& grid_from_tool) noexcept;

  /// Lower bound of how far, in voxels, the block's probes are from solid bone, but for the rounding of the
  /// sphere's place, which is below a voxel; not above 0 when they may touch.
  float voxels(const ContactShell& shell, uint32_t block) const noexcept;
  float voxels_per_mm() const noexcept { return voxels_per_mm_; }

 private:
  const voxel::BrickDistance& distance_;
  GridAffine voxel_from_tool_;
  float voxels_per_mm_;  ///< along the smallest edge
};

/// What culls whole blocks at one pose: the VOI and the conservative distance to bone.
class Culling {
 public:
  Culling(const NarrowPhaseInput& input, const Voi& voi, const QuantisedPose& grid_from_tool) noexcept;

  /// Lower bound of how far, in voxels, the block's probes are from touching; not above 0 when they may
  /// touch.
  float gap_voxels(const ContactShell& shell, uint32_t block) const noexcept;

 private:
  BoneGap gap_;
  Vec3f low_mm_, high_mm_;  ///< VOI, tool frame
};

}  // namespace ream::collide
