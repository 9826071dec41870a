#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "collide/profile_table.hpp"
#include "collide/removal.hpp"

namespace ream::collide {

/// Decides which bricks removal looks at in a tick. A brick at the cutting surface is looked at again after
/// 1/32 voxel of tool motion; one whose bone is farther away, only after the tool has moved that far; an
/// empty one never again. Runs on the host from poses and coverage, so every device visits the same bricks.
/// No allocation after construction.
class RemovalSchedule {
 public:
  /// Motion after which a brick is due again, in voxels (one coverage step is 1/255 voxel; creep is far
  /// below).
  static constexpr double revisit_voxels = 1.0 / 32.0;

  /// Bricks measured a tick while nothing is cut, so that the first contact does not find them all
  /// unmeasured.
  static constexpr size_t idle_budget = 48;

  RemovalSchedule(const shell::SweptProfile& profile, const voxel::BoneModel& bone);

  /// Bricks to cut at this pose; the list stays valid until the next call.
  std::span<const uint32_t> due(const QuantisedPose& grid_from_tool) noexcept;
  /// A tick in which nothing is cut: keeps track of the motion and measures a few bricks ahead.
  void pass(const QuantisedPose& grid_from_tool) noexcept;
  /// What became of a brick of due(): an unchanged one is measured before it is cut again, an empty one
  /// retired.
  void cut_done(uint32_t brick, bool changed, bool empty) noexcept;

  /// The table margin that swept_profile() must be given for a grid so that brick distances can be bounded.
  static double needed_margin_mm(const voxel::VoxelGrid& grid);

 private:
  double advance_odometer(const Pose& grid_from_tool) noexcept;
  void rebuild_active(const Pose& grid_from_tool) noexcept;
  float brick_distance_mm(uint32_t brick, const GridAffine& tool_from_voxel) const noexcept;
  double gap_voxels(uint32_t brick, const GridAffine& tool_from_voxel) const noexcept;
  double measured_gap_voxels(uint32_t brick, const GridAffine& tool_from_voxel) const noexcept;
  void follow(const QuantisedPose& grid_from_tool) noexcept;

  const shell::SweptProfile& profile_;
  const ProfileTable table_;
  const voxel::BoneModel& bone_;
  const voxel::VoxelGrid grid_;
  Aabb body_tool_mm_;
  double brick_reach_mm_;  ///< half diagonal of a brick and half a voxel
  std::vector<uint8_t> empty_;
  std::vector<uint8_t> hot_;      ///< changed at its last cut: no need to measure it before the next
  std::vector<double> due_at_;    ///< odometer reading at which a brick is due
  std::vector<uint32_t> active_;  ///< non-empty bricks within a voxel and a half of the body
  std::vector<uint32_t> due_;
  size_t active_count_ = 0, next_to_measure_ = 0;
  Pose previous_;
  bool started_ = false;
  double odometer_voxels_ = 0.0;  ///< upper bound of the path of any point of the body
  double rebuild_at_ = 0.0;
};

}  // namespace ream::collide
