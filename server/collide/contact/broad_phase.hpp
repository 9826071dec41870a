#pragma once
#include "collide/contact/contact_shell.hpp"
#include "collide/grid_transform.hpp"
#include "geometry/box.hpp"
#include "voxel/brick_distance.hpp"

namespace ream::collide {

/// Volume of interest: the part of the tool's box, tool frame, in which bone may lie (thesis 4.4). Always an
/// over-estimate, so culling by it never changes a result.
struct Voi {
  bool touching = false;  ///< false: nothing to do this tick
  Aabb box_tool_mm;
};

/// `bone_box_grid` is around the bone that is left (SolidCells::bounds_mm).
/// OBB/SAT test of the tool's box (tool frame) against the bone's box (grid frame), each grown by `reach_mm`,
/// then the overlap of the bone's box, expressed in the tool frame, with the tool's box.
Voi broad_phase(const Aabb& bone_box_grid, const Aabb& tool_box_tool, const Pose& grid_from_tool,
                double reach_mm) noexcept;

/// Separating-axis test of two oriented boxes given in one frame (15 axes; Gottschalk et al. 1996,
/// thesis 4.4). True when they touch or overlap; nearly parallel edges never separate by rounding.
bool overlap(const Obb& a, const Obb& b) noexcept;

/// How far the shell's blocks are from bone at one pose, by their spheres and the conservative distance.
class BoneGap {
 public:
  BoneGap(const voxel::BrickDistance& distance, const voxel::VoxelGrid& grid,
          const QuantisedPose& grid_from_tool) noexcept;

  /// Lower bound of how far, in voxels, the block's probes are from bone, but for the rounding of the
  /// sphere's place, which is below a voxel. They touch no farther than a voxel from it.
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
  Culling(const voxel::BrickDistance& distance, const voxel::VoxelGrid& grid, const Voi& voi,
          const QuantisedPose& grid_from_tool) noexcept;

  /// Lower bound of how far, in voxels, the block's probes are from touching; not above 0 when they may
  /// touch.
  float gap_voxels(const ContactShell& shell, uint32_t block) const noexcept;

 private:
  BoneGap gap_;
  Vec3f low_mm_, high_mm_;  ///< VOI, tool frame
};

}  // namespace ream::collide
