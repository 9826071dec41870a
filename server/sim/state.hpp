#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "collide/narrow_phase.hpp"
#include "collide/removal.hpp"
#include "collide/removal_schedule.hpp"
#include "sim/model.hpp"
#include "voxel/bricks.hpp"

namespace ream::sim {

/// What one tick found and did; everything that followers (trace, telemetry, recording, score) need to know.
/// Trivially copyable: it travels through rings.
struct TickReport {
  uint32_t tick = 0;
  bool spindle_on = false, paused = false, engaged = false;
  QuantisedPose grid_from_tool;
  Pose world_from_tool, world_from_handle;
  Vec3 hand_force_n = Vec3::Zero();       ///< sent to the device, world frame
  Vec3 hand_torque_n_mm = Vec3::Zero();
  double thrust_n = 0.0;                  ///< simulated, along the tool axis, pressing into the bone positive
  double torque_n_mm = 0.0;               ///< simulated, magnitude of the moment about the tool's origin
  double feed_rate_mm_s = 0.0;            ///< of the tool along its axis while engaged
  double density_g_cc = 0.0;              ///< mean of the engaged cutting points
  double share[3] = {0, 0, 0};            ///< cancellous, cortical, cartilage
  int64_t engaged_points = 0;
  int64_t coverage_removed[3] = {0, 0, 0};  ///< this tick, coverage levels by class
  uint32_t changed_bricks = 0;
  uint64_t session_hash = 0;              ///< rolling, up to and including this tick
};

/// Microseconds of wall time per stage of one tick; measured, never decided upon.
struct StageTimes {
  double contact_us = 0, force_us = 0, removal_us = 0, bricks_us = 0;
};

/// Everything that a tick changes. Owned by the haptic thread once the session runs.
struct State {
  State(const Model& model, voxel::BoneModel& bone);

  voxel::BoneModel& bone;
  std::unique_ptr<collide::NarrowPhase> narrow_phase;
  std::unique_ptr<collide::Removal> removal;
  collide::RemovalSchedule schedule;
  std::vector<uint8_t> changed, empty;      ///< per entry of the schedule's list
  voxel::BrickSender* brick_sender = nullptr;  ///< followers, where there are any; not owned
  int brick_budget = 256;                   ///< images sent a tick

  bool started = false;                     ///< the tool has been put at the handle
  uint32_t tick = 0;
  Pose world_from_tool;
  uint64_t session_hash = 0;
  StageTimes times;
};

/// Name of the backend that `settings.backend` means here, for people ("cpu", "opencl: <device>").
std::string backend_name(const Settings& settings);

}  // namespace ream::sim
