#include "sim/approach.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "collide/contact/broad_phase.hpp"

namespace ream::sim {
namespace {

/// Covers the rounding of the spheres' places, and that bone is felt in the voxel next to a probe's.
constexpr float slack_voxels = 2.5f;

/// Path, mm, that every probe of the tool may go from where it stands, in any direction, without meeting
/// bone: a lower bound from the distance field, 0 near bone. Removal only adds to it.
double clearance_mm(const Model& model, State& state) noexcept {
  const collide::ContactShell& shell = model.contact_shell;
  const size_t blocks = shell.blocks.size();
  const voxel::VoxelGrid& grid = state.bone.grid;
  const QuantisedPose pose = quantised(state.world_from_grid.inverse() * state.world_from_tool);
  const collide::BoneGap bone_gap(model.distance, grid, pose);
  float nearest = 1.0e6f;
  // The block that was nearest last time comes first: beside bone it alone answers.
  const size_t first = state.nearest_block;
  for (size_t i = 0; i < blocks && nearest > slack_voxels; ++i) {
    const size_t b = first + i < blocks ? first + i : first + i - blocks;
    const float gap = bone_gap.voxels(shell, static_cast<uint32_t>(b));
    if (gap >= nearest) continue;
    nearest = gap;
    state.nearest_block = b;
  }
  return std::max(0.0, static_cast<double>(nearest - slack_voxels)) * grid.min_spacing_mm();
}

/// Contact of the tool as it stands; remembers when there is none.
Approach look(const Model& model, State& state) noexcept {
  Approach found;
  const QuantisedPose pose = quantised(state.world_from_grid.inverse() * state.world_from_tool);
  const collide::Voi voi = collide::broad_phase(state.cells.bounds_mm(), model.tool_box_tool,
                                                dequantised(pose), model.contact_reach_mm);
  found.ok = work_or_fail_over(
      state, [&](const Backend& backend) { return backend.narrow_phase->contact(pose, voi, found.sums); });
  state.free_path_mm = found.ok && found.sums.engaged() == 0 ? 0.0 : -1.0;
  return found;
}

/// Where contact begins on the way from `world_from_free`, where the tool touches nothing, to where it stands
/// and touches: halves the way until it is short enough. The tool ends where it touches.
Approach first_touch(const Model& model, State& state, Pose world_from_free, const Approach& there) noexcept {
  Approach touching = there;
  Pose world_from_touch = state.world_from_tool;
  double way_mm = path_bound_mm(model, world_from_free, world_from_touch);
  for (; way_mm > touch_within_voxels * model.thin_step_mm && touching.ok; way_mm *= 0.5) {
    const Pose world_from_middle = between(world_from_free, world_from_touch, 0.5);
    state.world_from_tool = world_from_middle;
    const Approach found = look(model, state);
    if (found.ok && found.sums.engaged() == 0) {
      world_from_free = world_from_middle;
      continue;
    }
    touching = found;
    world_from_touch = world_from_middle;
  }
  state.world_from_tool = world_from_touch;
  state.free_path_mm = -1.0;
  return touching;
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
    if (state.world_from_tool == world_from_handle) break;
    const double left_mm = path_bound_mm(model, state.world_from_tool, world_from_handle);
    if (left_mm > state.free_path_mm)
      state.free_path_mm = std::max(state.free_path_mm, clearance_mm(model, state));
    const bool blind = state.free_path_mm >= std::min(left_mm, look_every_mm);
    const double step_mm = std::min(left_mm, blind ? state.free_path_mm : look_every_mm);
    const Pose world_from_free = state.world_from_tool;
    state.world_from_tool = step_mm >= left_mm
                                ? world_from_handle
                                : between(state.world_from_tool, world_from_handle, step_mm / left_mm);
    state.free_path_mm -= step_mm;
    if (blind) continue;
    found = look(model, state);
    if (found.ok && found.sums.engaged() > 0) return first_touch(model, state, world_from_free, found);
  }
  return found;
}

}  // namespace ream::sim
