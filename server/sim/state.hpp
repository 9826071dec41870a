#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "collide/removal_schedule.hpp"
#include "record/tick_report.hpp"
#include "sim/backend.hpp"
#include "voxel/bricks.hpp"

namespace ream::sim {

/// Everything that a tick changes. Owned by the haptic thread once the session runs.
struct State {
  State(const Model& model, voxel::BoneModel& bone);

  voxel::BoneModel& bone;
  voxel::SolidCells cells;  ///< what of the bone is left; follows every cut
  Backend backend;
  collide::RemovalSchedule schedule;
  std::vector<uint8_t> changed, empty;         ///< per entry of the schedule's list
  voxel::BrickSender* brick_sender = nullptr;  ///< followers, where there are any; not owned
  int brick_budget = 256;                      ///< images sent a tick

  bool started = false;  ///< the tool has been put at the handle
  uint32_t tick = 0;
  Pose world_from_tool;
  uint64_t session_hash = 0;
};

using record::TickReport;

}  // namespace ream::sim
