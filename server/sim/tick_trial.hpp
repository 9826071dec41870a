#pragma once
#include <vector>

#include "sim/backend.hpp"
#include "sim/state.hpp"

namespace ream::sim {

/// What a tick does to contact and removal, without changing any bone: the tool pressed on it, looked at
/// again and again, and bricks to work through.
class TickTrial {
 public:
  TickTrial(const Model& model, const voxel::BoneModel& bone, const voxel::SolidCells& cells);

  /// How far along the plan's axis the tool has `target_share` of its points engaged; the deepest place that
  /// is looked at when it never has.
  double pressed_depth_mm(collide::NarrowPhase& narrow_phase, double target_share) const;

  /// One tick's work, `number` creeps past the depth; how long it took, or a negative number when the device
  /// failed.
  double tick_us(Backend& backend, double depth_mm, int number) const;

 private:
  bool look(collide::NarrowPhase& narrow_phase, double depth_mm, collide::ContactSums& sums) const;
  bool pass_over_bricks(Backend& backend) const;

  const Model& model_;
  const voxel::SolidCells& cells_;
  Pose grid_from_plan_;
  std::vector<uint32_t> bricks_;
};

/// How long slow ticks of this session will take, us: contact and removal are rehearsed with the tool pressed
/// on the bone, without changing anything. The larger of the 99th percentile of the time that this thread
/// computed and the median of what passed on the clock (a device that others compute on), so that a busy
/// machine does not make it longer. Takes about 0.2 s; before the first tick.
double rehearsed_tick_us(const Model& model, State& state);

}  // namespace ream::sim
