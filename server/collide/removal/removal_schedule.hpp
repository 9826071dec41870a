#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "collide/grid_transform.hpp"
#include "collide/removal/removal.hpp"

namespace ream::collide {

/// Decides which bricks removal looks at in a tick. A brick at the cutting surface is looked at again after
/// 1/64 voxel of tool motion; one whose bone is farther away, only after the tool has moved that far; an
/// empty one never again. Runs on the host from poses and outcomes, so every device visits the same bricks.
/// No allocation after construction; memory is a bit a brick and 16 bytes for each brick that fits around
/// the tool.
class RemovalSchedule {
 public:
  /// Motion after which a brick is due again, in voxels (one coverage step is 1/255 voxel; creep is far
  /// below).
  static constexpr double revisit_voxels = 1.0 / 64.0;

  /// Bricks cut in one tick at most; a quarter in ticks that first list the bricks near the tool, once in a
  /// voxel of motion. Where more are due (when the tool comes to bone that it has not been near, a few
  /// thousand) they are taken in turn: of n due bricks each is cut within n / 128 ticks or so.
  static constexpr size_t max_bricks_per_tick = 128;

  RemovalSchedule(const shell::SweptProfile& profile, const voxel::BoneModel& bone);

  /// Bricks to cut at this pose; the list stays valid until the next call.
  std::span<const uint32_t> due(const QuantisedPose& grid_from_tool) noexcept;
  /// What became of brick number `i` of due().
  void cut_done(size_t i, const BrickOutcome& outcome) noexcept;
  /// A tick in which nothing is cut: keeps track of the motion.
  void pass(const QuantisedPose& grid_from_tool) noexcept;

  /// Bytes held.
  size_t bytes() const noexcept {
    return occupied_.size() * sizeof(uint32_t) + (near_.size() + next_.size()) * sizeof(Near);
  }

  /// The table margin that swept_profile() must be given for a grid so that brick distances can be bounded.
  static double needed_margin_mm(const voxel::VoxelGrid& grid);

 private:
  /// A brick that holds bone near the body.
  struct Near {
    uint32_t brick = 0;
    float due_voxels = 0.0f;  ///< odometer reading at which it is due, less base_voxels_
  };

  size_t max_near_bricks() const;
  void find_near_bricks(const Pose& grid_from_tool) noexcept;
  void scan_row(int y, int z, int first_x, int last_x, const GridAffine& tool_from_voxel,
                size_t& old) noexcept;
  float brick_distance_mm(const Vec3i& brick, const GridAffine& tool_from_voxel) const noexcept;
  float wait_voxels(float brick_distance_mm) const noexcept;
  float gone() const noexcept { return static_cast<float>(odometer_.voxels() - base_voxels_); }

  const shell::SweptProfile& profile_;
  const voxel::VoxelGrid grid_;
  Aabb body_tool_mm_;
  Odometer odometer_;
  double brick_reach_mm_;  ///< half diagonal of a brick and half a voxel
  double near_mm_;         ///< bricks up to this distance are listed
  int words_a_row_;
  std::vector<uint32_t> occupied_;  ///< a bit a brick, rows along x padded to words: holds bone
  std::vector<Near> near_, next_;   ///< ascending by brick; next_ is being made
  size_t near_count_ = 0, next_count_ = 0;
  size_t turn_ = 0;                                  ///< entry of near_ that is asked first
  std::array<uint32_t, max_bricks_per_tick> due_;    ///< brick
  std::array<uint32_t, max_bricks_per_tick> entry_;  ///< its place in near_
  double base_voxels_ = 0.0;                         ///< odometer reading when near_ was made
  bool listed_ = false;
};

/// Cuts what is due at a pose, and tells each brick that has changed. `cut(due)` fills `outcomes`, which has
/// room for max_bricks_per_tick; where it answers false, so does this, and nothing more is done.
template <typename Cut, typename Changed>
bool cut_due(RemovalSchedule& schedule, const QuantisedPose& grid_from_tool,
             std::span<const BrickOutcome> outcomes, Cut cut, Changed changed) noexcept {
  const std::span<const uint32_t> due = schedule.due(grid_from_tool);
  if (!cut(due)) return false;
  for (size_t i = 0; i < due.size(); ++i) {
    schedule.cut_done(i, outcomes[i]);
    if (outcomes[i].changed) changed(due[i]);
  }
  return true;
}

}  // namespace ream::collide
