#pragma once
#include <array>
#include <cstdint>

#include "collide/removal/removal_schedule.hpp"
#include "force/heat.hpp"
#include "force/spindle.hpp"
#include "force/vibration/vibration_player.hpp"
#include "record/tick_report.hpp"
#include "sim/backend.hpp"
#include "sim/hand_output.hpp"
#include "sim/scapula_mount.hpp"
#include "voxel/bricks.hpp"

namespace ream::sim {

/// What a segment of a session takes over from the one before it; else the session begins.
struct ResumeState {
  uint32_t tick = 0;  ///< the next
  uint64_t session_hash = 0;
};

/// What a tick leaves to the next, the bone apart. With the bone as it was then, a copy is a moment that a
/// session can go back to.
struct Moment {
  Moment(const Model& model, const voxel::BoneModel& bone, const ResumeState& from);

  collide::RemovalSchedule schedule;
  bool started = false;  ///< the tool has been put at the handle
  uint32_t tick = 0;     ///< the next
  Pose world_from_tool;
  /// Whatever way the tool moves, as far as this no point of it meets bone (mm). 0: it touches nothing where
  /// it stands; negative: nobody has looked there yet.
  double free_path_mm = -1.0;
  size_t nearest_block = 0;                ///< of the shell to bone, when that was last looked for
  force::Vec6 tool_twist{};                ///< of the last tick, tool frame: mm/s, rad/s
  Vec3 tick_from_mm = Vec3::Zero();        ///< where the tool was when the tick began, world frame
  double tool_speed_mm_s = 0.0;            ///< of its origin, of the last tick
  Vec3 last_cut_mm = Vec3::Constant(1e9);  ///< where the tool was when it cut last, grid frame
  bool slips = false;                      ///< free of the bone, and not yet where the hand is
  double thrust_n = 0.0;                   ///< simulated, of the last tick
  double normal_force_n = 0.0;  ///< simulated, of the last tick, that presses tool and bone together
  /// Load of the cutting edge along its normal in the last tick, N per unit of the contact sums' weight, of
  /// lips that cut or rub.
  double edge_load_n = 0.0;
  force::Spindle spindle;
  force::SpindleLoad spindle_load;  ///< of the last tick
  HandOutput output;
  force::VibrationPlayer vibration;
  force::GuideState guide;
  MountState mount;
  force::HeatedBone heat;
  Pose world_from_bone_rest;  ///< how far the bone has moved from where the case has it
  Pose world_from_grid;       ///< of the bone where it is now; the grid's own is where it rests
  uint64_t session_hash = 0;
};

/// Everything that a tick changes, and what computes it. Owned by the haptic thread once the session runs.
struct State : Moment {
  State(const Model& model, voxel::BoneModel& bone, const ResumeState& from = {});
  /// Goes on from a moment of a session with this model. `bone`: as it was then.
  State(const Model& model, voxel::BoneModel& bone, const Moment& from);

  voxel::BoneModel& bone;
  voxel::SolidCells cells;  ///< what of the bone is left; follows every cut
  Backend backend;
  /// The C++ form, ready in case the device of `backend` fails; empty parts when `backend` is it already.
  Backend reserve;
  /// The tick in which the reserve took over. Set before the first tick it repeats a recorded failure: the
  /// hand feels nothing in that tick, and no other device may fail.
  int64_t failed_over_tick = -1;
  std::array<collide::BrickOutcome, collide::RemovalSchedule::max_bricks_per_tick> outcomes;
  std::array<uint32_t, collide::RemovalSchedule::max_bricks_per_tick> changed;  ///< bricks of the last cut
  size_t changed_count = 0;
  voxel::BrickSender* brick_sender = nullptr;  ///< followers, where there are any; not owned
  int brick_budget = 256;                      ///< images sent a tick

  /// The input's pose is the handle's from the first tick to the last, also where a virtual mass would
  /// otherwise fly under the hand's force: of recorded causes.
  bool handle_given = false;
};

using record::TickReport;

/// Puts the reserve in the failed backend's place; the failed one is kept, for giving it back takes time that
/// a tick has not. False when there is no reserve (any more). What the failed device left behind: bone on the
/// host is as before its last call (Removal::cut, Decay::apply), so the reserve does the same work again and
/// the tick's result, coverage and hash are those of a session without a failure.
bool fail_over(State& state) noexcept;

/// Calls `work(backend)`, which answers false when the device failed, once more with the reserve if need be.
template <class Work>
bool work_or_fail_over(State& state, Work work) noexcept {
  return work(state.backend) || (fail_over(state) && work(state.backend));
}

}  // namespace ream::sim
