#include "sim/approach.hpp"

#include <algorithm>
#include <cmath>

namespace ream::sim {

double largest_motion_mm(const Model& model, const Pose& world_from_a, const Pose& world_from_b) noexcept {
  double largest = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Aabb& box = model.tool_box_tool;
    const Vec3 p(i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                 i & 4 ? box.max.z() : box.min.z());
    const Vec3 moved = world_from_b.point(p) - world_from_a.point(p);
    largest = std::max(largest, moved.cwiseAbs().sum());
  }
  return largest;
}

Pose between(const Pose& world_from_a, const Pose& world_from_b, double fraction) noexcept {
  const Vec3 turn = small_vector_from_rotation(world_from_a.rotation.transpose() * world_from_b.rotation);
  return {
      orthonormalized(world_from_a.rotation * rotation_from_small_vector(fraction * turn)),
      world_from_a.translation_mm + fraction * (world_from_b.translation_mm - world_from_a.translation_mm)};
}

Approach look(const Model& model, State& state) noexcept {
  Approach found;
  const QuantisedPose pose = quantised(state.bone.grid.world_from_grid.inverse() * state.world_from_tool);
  found.voi = collide::broad_phase(state.cells.bounds_mm(), model.tool_box_tool, dequantised(pose),
                                   model.thin_step_mm);
  found.ok = state.backend.narrow_phase->contact(pose, found.voi, found.sums);
  return found;
}

Approach approach(const Model& model, State& state, const Pose& world_from_handle) noexcept {
  Approach found = look(model, state);
  for (int i = 0; i < max_substeps && found.ok && found.sums.engaged() == 0; ++i) {
    const double left_mm = largest_motion_mm(model, state.world_from_tool, world_from_handle);
    if (left_mm == 0.0) break;
    state.world_from_tool = left_mm <= model.thin_step_mm ? world_from_handle
                                                          : between(state.world_from_tool, world_from_handle,
                                                                    model.thin_step_mm / left_mm);
    found = look(model, state);
  }
  return found;
}

}  // namespace ream::sim
