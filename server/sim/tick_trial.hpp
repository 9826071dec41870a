#pragma once
#include <vector>

#include "sim/backend.hpp"

namespace ream::sim {

/// What a tick does to contact and removal, without changing any bone: the tool pressed on it, looked at
/// again and again, and bricks to work through.
class TickTrial {
 public:
  TickTrial(const Model& model, const voxel::BoneModel& bone, const voxel::SolidCells& cells);

  /// How far along the plan's axis the tool has `wanted_share` of its points engaged; the deepest place that
  /// is looked at when it never has.
  double pressed_depth_mm(collide::NarrowPhase& narrow_phase, double wanted_share) const;

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

}  // namespace ream::sim
