#pragma once
#include "collide/grid_affine.hpp"
#include "collide/narrow_phase.hpp"

namespace ream::collide {

/// What culls whole blocks at one pose: the VOI and the conservative distance to bone.
class Culling {
 public:
  Culling(const NarrowPhaseInput& input, const Voi& voi, const QuantisedPose& grid_from_tool) noexcept;

  /// Lower bound of how far, in voxels, the block's probes are from touching; not above 0 when they may
  /// touch.
  float gap_voxels(const ContactShell& shell, uint32_t block) const noexcept;

 private:
  const voxel::BrickDistance& distance_;
  GridAffine voxel_from_tool_;
  Vec3f low_mm_, high_mm_;  ///< VOI, tool frame
  float voxels_per_mm_;
};

}  // namespace ream::collide
