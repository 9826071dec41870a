#pragma once
#include <cstdint>

#include "device/haptic_device.hpp"
#include "geometry/pose.hpp"

namespace ream::record {

/// Bits of ops::Tick::flags; proto/recording.json names them.
enum TickFlag : uint32_t {
  spindle_on_flag = 1,
  paused_flag = 2,
  failed_over_flag = 4,
  engaged_flag = 8,
  cutting_flag = 16,
  weakened_flag = 32,
  stale_flag = 64,
  reversed_flag = 128,
  irrigating_flag = 256,
  stalled_flag = 512
};

/// Beside the flags: how far the trigger is from being pressed all the way, so that 0 is what older
/// recordings had.
inline constexpr int trigger_slack_shift = 16;

/// When a tick began and how long its parts took, us.
struct TickTiming {
  double lateness_us = 0.0, read_us = 0.0, step_us = 0.0, write_us = 0.0;
};

/// What one tick was told, found and did: everything that followers (trace, telemetry, recording, score) need
/// to know. Trivially copyable: it travels through rings.
struct TickReport {
  uint32_t tick = 0;
  bool spindle_on = false, paused = false, engaged = false;
  bool cutting = false;  ///< engaged, spindle on, pressed enough, and the lips have bone to cut
  /// The hand feels noticeably less than the simulated contact force over the force scale: a limit, the slew
  /// limit or the energy guard is at work.
  bool weakened = false;
  bool stalled = false;  ///< the drive cannot turn the reamer against the bone
  device::DriveControls drive;
  bool stale = false;  ///< a cause: the pose was too old, the force on the hand fades out
  device::LinkState link = device::LinkState::fresh;  ///< of the device; not recorded
  bool held = false;         ///< paused by somebody else than the device, whatever it says; not recorded
  bool failed_over = false;  ///< the device that computes failed in this tick; the hand felt nothing
  QuantisedPose world_from_handle_q;  ///< the cause: what the device said, as it was used
  QuantisedPose grid_from_tool;       ///< what was decided, as contact and removal saw it
  Pose world_from_tool, world_from_handle;
  Pose world_from_bone_rest;             ///< how far the bone has moved from where the case has it
  Vec3 hand_force_n = Vec3::Zero();      ///< sent to the device, world frame
  Vec3 hand_vibration_n = Vec3::Zero();  ///< the part of it that is vibration
  Vec3 hand_torque_n_mm = Vec3::Zero();
  double thrust_n = 0.0;               ///< simulated, along the tool axis, pressing into the bone positive
  double torque_n_mm = 0.0;            ///< simulated, magnitude of the moment about the tool's origin
  double spindle_torque_n_mm = 0.0;    ///< simulated, that turns the spindle; the hand holds against it
  double spindle_speed_rad_s = 0.0;    ///< as simulated; reversed negative
  double surface_temperature_c = 0.0;  ///< of the bone under the reamer; 0: not simulated
  double guide_force_n = 0.0;          ///< simulated, that the guide takes; in no other figure but the hand's
  double vibration_g = 0.0;            ///< acceleration of the tool beside what contact does
  double feed_rate_mm_s = 0.0;         ///< of the tool along its axis while engaged
  double density_g_cc = 0.0;           ///< mean of the engaged cutting points
  double share[3] = {0, 0, 0};         ///< cancellous, cortical, cartilage
  int64_t engaged_points = 0;
  int64_t coverage_removed[3] = {0, 0, 0};  ///< this tick, coverage levels (1/255 voxel) by class
  uint32_t changed_bricks = 0;
  uint32_t bricks_waiting = 0;  ///< changed ones whose images go to followers in later ticks
  uint64_t session_hash = 0;    ///< rolling, up to and including this tick
  TickTiming timing;            ///< of this computer; not recorded
};

/// What of a tick's flags a drive's controls are, and back.
uint32_t drive_flags(const device::DriveControls& drive) noexcept;
device::DriveControls drive_of_flags(uint32_t flags) noexcept;

}  // namespace ream::record
