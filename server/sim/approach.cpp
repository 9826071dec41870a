#include "sim/approach.hpp"

#include <algorithm>

#include "sim/clearance.hpp"
#include "sim/failover.hpp"

namespace ream::sim {
namespace {

bool same(const Pose& a, const Pose& b) {
  return a.translation_mm == b.translation_mm && a.rotation == b.rotation;
}

/// Contact of the tool as it stands; remembers when there is none.
Approach look(const Model& model, State& state) noexcept {
  Approach found;
  const QuantisedPose pose = quantised(state.world_from_grid.inverse() * state.world_from_tool);
  const collide::Voi voi = collide::broad_phase(state.cells.bounds_mm(), model.tool_box_tool,
                                                dequantised(pose), model.thin_step_mm);
  found.ok = work_or_fail_over(
      state, [&](const Backend& backend) { return backend.narrow_phase->contact(pose, voi, found.sums); });
  state.free_path_mm = found.ok && found.sums.engaged() == 0 ? 0.0 : -1.0;
  return found;
}

}  // namespace

double path_bound_mm(const Model& model, const Pose& world_from_a, const Pose& world_from_b) noexcept {
  const Vec3 turn = turn_between(world_from_a.rotation, world_from_b.rotation);
  double arc = 0.0;
  for (int i = 0; i < 8; ++i) arc = std::max(arc, length_bound(turn.cross(model.tool_box_tool.corner(i))));
  return length_bound(world_from_b.translation_mm - world_from_a.translation_mm) + arc;
}

Pose between(const Pose& world_from_a, const Pose& world_from_b, double fraction) noexcept {
  const Vec3 turn = turn_between(world_from_a.rotation, world_from_b.rotation);
  return {
      orthonormalized(world_from_a.rotation * rotation_from_small_vector(fraction * turn)),
      world_from_a.translation_mm + fraction * (world_from_b.translation_mm - world_from_a.translation_mm)};
}

Approach approach(const Model& model, State& state, const Pose& world_from_handle) noexcept {
  const double look_every_mm = look_every_voxels * model.thin_step_mm;
  Approach found;
  if (state.free_path_mm < 0.0) found = look(model, state);
  for (int i = 0; i < max_moves && found.ok && found.sums.engaged() == 0; ++i) {
    if (same(state.world_from_tool, world_from_handle)) break;
    const double left_mm = path_bound_mm(model, state.world_from_tool, world_from_handle);
    if (left_mm > state.free_path_mm)
      state.free_path_mm = std::max(state.free_path_mm, clearance_mm(model, state));
    const bool blind = state.free_path_mm >= std::min(left_mm, look_every_mm);
    const double step_mm = std::min(left_mm, blind ? state.free_path_mm : look_every_mm);
    state.world_from_tool = step_mm >= left_mm
                                ? world_from_handle
                                : between(state.world_from_tool, world_from_handle, step_mm / left_mm);
    state.free_path_mm -= step_mm;
    if (!blind) found = look(model, state);
  }
  return found;
}

}  // namespace ream::sim
