#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "collide/removal.hpp"

namespace ream::collide {

/// Decides which bricks removal looks at in a tick. A brick near the cutting body is looked at again after 1/32 voxel
/// of tool motion, or later when it is farther away than that; bricks that have become empty never again. A
/// function of the poses alone, so every device visits the same bricks. No allocation after construction.
class RemovalSchedule {
 public:
  /// Motion after which a brick is due again, in voxels (one coverage step is 1/255 voxel; creep is far below).
  static constexpr double revisit_voxels = 1.0 / 32.0;

  RemovalSchedule(const shell::SweptProfile& profile, const voxel::BoneModel& bone);

  /// Bricks due at this pose; the list stays valid until the next call.
  std::span<const uint32_t> due(const QuantisedPose& grid_from_tool) noexcept;
  /// Tells that a brick has nothing left.
  void retire(uint32_t brick) noexcept { empty_[brick] = 1; }

  /// The table margin that swept_profile() must be given for a grid so that brick distances can be bounded.
  static double needed_margin_mm(const voxel::VoxelGrid& grid);

 private:
  double advance_odometer(const Pose& grid_from_tool) noexcept;
  void rebuild_active(const Pose& grid_from_tool) noexcept;
  float brick_distance_mm(uint32_t brick, const GridAffine& tool_from_voxel) const noexcept;

  const shell::SweptProfile& profile_;
  const voxel::VoxelGrid grid_;
  Aabb body_tool_mm_;
  double brick_reach_mm_;            ///< half diagonal of a brick and half a voxel
  std::vector<uint8_t> empty_;
  std::vector<double> due_at_;       ///< odometer reading at which a brick is due
  std::vector<uint32_t> active_;     ///< non-empty bricks within a voxel and a half of the body
  std::vector<uint32_t> due_;
  size_t active_count_ = 0;
  Pose previous_;
  bool started_ = false;
  double odometer_voxels_ = 0.0;     ///< upper bound of the path of any point of the body
  double rebuild_at_ = 0.0;
};

}  // namespace ream::collide
