#include "sim/step.hpp"

#include <cmath>

#include "core/clock.hpp"
#include "core/hash.hpp"
#include "force/coefficients.hpp"
#include "sim/approach.hpp"
#include "sim/contact_resistance.hpp"
#include "sim/guided_handle.hpp"
#include "sim/remove_bone.hpp"

namespace ream::sim {
namespace {

/// Handle minus tool in the tool frame: mm, then rotation vector in rad.
force::Vec6 handle_minus_tool(const Pose& world_from_tool, const Pose& world_from_handle) {
  const Mat3 tool_from_world = world_from_tool.rotation.transpose();
  const Vec3 d = tool_from_world * (world_from_handle.translation_mm - world_from_tool.translation_mm);
  const Vec3 r = small_vector_from_rotation(tool_from_world * world_from_handle.rotation);
  return {d.x(), d.y(), d.z(), r.x(), r.y(), r.z()};
}

Pose moved(const Pose& world_from_tool, const force::Vec6& motion, double fraction) {
  const Vec3 shift(motion[0], motion[1], motion[2]), turn(motion[3], motion[4], motion[5]);
  return {orthonormalized(world_from_tool.rotation * rotation_from_small_vector(fraction * turn)),
          world_from_tool.translation_mm + world_from_tool.rotation * (fraction * shift)};
}

/// Advance against contact: no point goes farther than one look for contact allows, so that nothing is
/// jumped.
Pose moved_within_a_voxel(const Model& model, const Pose& world_from_tool, const force::Vec6& motion) {
  const Pose whole = moved(world_from_tool, motion, 1.0);
  const double limit_mm = look_every_voxels * model.thin_step_mm;
  const double path_mm = path_bound_mm(model, world_from_tool, whole);
  return path_mm <= limit_mm ? whole : moved(world_from_tool, motion, limit_mm / path_mm);
}

/// Spring, feed law and motion of the tool that touches bone; fills the force part of the report. What the tool
/// puts on the bone, simulated.
Load press(const Model& model, State& state, const collide::ContactSums& sums,
           const device::DeviceInput& input, TickReport& report) {
  const force::EngagedBone bone = engaged_bone(model, sums);
  const force::CuttingLoad load = bone.any() ? model.feed->load(bone, state.thrust_n) : force::CuttingLoad{};
  const force::Vec6 delta = handle_minus_tool(state.world_from_tool, input.world_from_handle);
  const auto couple_when = [&](bool cuts) {
    return force::couple(model.coupling, contact_resistance(model, sums, load.resistance_n_s_mm, cuts), delta,
                         tick_s);
  };
  force::CouplingStep coupled = couple_when(input.spindle_on);
  const double thrust_n = coupled.wrench_on_tool[2];
  if (input.spindle_on && std::abs(thrust_n) < force::start_threshold_n) coupled = couple_when(false);

  const Vec3 before = state.world_from_tool.translation_mm;
  const Vec3 axis = state.world_from_tool.rotation.col(2);
  const Mat3 world_from_tool_axes = state.world_from_tool.rotation;
  state.world_from_tool = moved_within_a_voxel(model, state.world_from_tool, coupled.tool_motion);
  state.free_path_mm = -1.0;

  const auto& w = coupled.wrench_on_tool;
  const Vec3 force_on_tool(w[0], w[1], w[2]), torque_on_tool(w[3], w[4], w[5]);
  const double per_hand = 1.0 / model.coupling.force_scale;
  report.engaged = true;
  report.thrust_n = w[2];
  report.torque_n_mm = torque_on_tool.norm();
  report.feed_rate_mm_s = axis.dot(state.world_from_tool.translation_mm - before) / tick_s;
  report.density_g_cc = bone.mean_density_g_cc();
  for (size_t k = 0; k < 3; ++k) report.share[k] = bone.share[k];
  report.engaged_points = sums.engaged();
  report.hand_force_n =
      force::limited(world_from_tool_axes * (-per_hand * force_on_tool), model.settings.limits.force_max_n);
  report.hand_torque_n_mm = force::limited(world_from_tool_axes * (-per_hand * torque_on_tool),
                                           model.settings.limits.torque_max_n_mm);
  return {world_from_tool_axes * force_on_tool, world_from_tool_axes * torque_on_tool};
}

/// The guide's share of what the hand feels.
void add_to_hand(const Model& model, const Load& on_guide, TickReport& report) {
  const double per_hand = 1.0 / model.coupling.force_scale;
  report.hand_force_n =
      force::limited(report.hand_force_n - per_hand * on_guide.force_n, model.settings.limits.force_max_n);
  report.hand_torque_n_mm = force::limited(report.hand_torque_n_mm - per_hand * on_guide.torque_n_mm,
                                           model.settings.limits.torque_max_n_mm);
}

/// Contact, guide and a bone that gives way: one tick of a tool that is not paused. False when the device that
/// computes failed.
bool move_tool(const Model& model, State& state, const device::DeviceInput& input, TickReport& report) {
  device::DeviceInput allowed = input;
  allowed.world_from_handle = guided(model, state, input.world_from_handle);
  const Approach found = approach(model, state, allowed.world_from_handle);
  if (!found.ok) return false;
  Load on_bone;
  if (found.sums.engaged() > 0) on_bone = press(model, state, found.sums, allowed, report);
  if (state.guide.entered) {
    const Load on_guide = load_on_guide(model, input.world_from_handle, allowed.world_from_handle);
    add_to_hand(model, on_guide, report);
    on_bone.force_n += on_guide.force_n;
    on_bone.torque_n_mm += on_guide.torque_n_mm;
  }
  move_bone(model, state, on_bone, report.engaged);
  keep_in_guide(model, state);
  return true;
}

/// The cause of the tick as it is recorded, folded into the rolling hash.
uint64_t hash_of_cause(const TickReport& report) {
  uint64_t h = hash_combine(
      report.tick, static_cast<uint64_t>(report.spindle_on) | static_cast<uint64_t>(report.paused) << 1);
  for (const int32_t q : report.grid_from_tool.rotation_q30) h = hash_combine(h, static_cast<uint32_t>(q));
  for (const int32_t q : report.grid_from_tool.translation_nm) h = hash_combine(h, static_cast<uint32_t>(q));
  return h;
}

bool is_finite(const TickReport& r) {
  return r.hand_force_n.allFinite() && r.hand_torque_n_mm.allFinite() &&
         r.world_from_tool.translation_mm.allFinite() && r.world_from_tool.rotation.allFinite() &&
         std::isfinite(r.thrust_n);
}

bool is_finite(const device::DeviceInput& input) {
  return input.world_from_handle.translation_mm.allFinite() && input.world_from_handle.rotation.allFinite();
}

}  // namespace

StepStatus step(const Model& model, State& state, const device::DeviceInput& raw_input,
                TickReport& report) noexcept {
  report = {};
  if (!is_finite(raw_input)) return StepStatus::not_finite;
  report.tick = state.tick++;
  report.spindle_on = raw_input.spindle_on;
  report.paused = raw_input.paused;
  report.world_from_handle_q = quantised(raw_input.world_from_handle);
  device::DeviceInput input = raw_input;
  input.world_from_handle = dequantised(report.world_from_handle_q);
  report.world_from_handle = input.world_from_handle;
  if (!state.started) state.world_from_tool = input.world_from_handle;
  state.started = true;

  if (!input.paused && !move_tool(model, state, input, report)) return StepStatus::collision_failed;
  state.thrust_n = report.thrust_n;
  report.world_from_tool = state.world_from_tool;
  report.world_from_bone_rest = state.world_from_bone_rest;
  report.grid_from_tool = quantised(state.world_from_grid.inverse() * state.world_from_tool);

  const bool cuts = report.engaged && input.spindle_on;
  if (!cuts) state.schedule.pass(report.grid_from_tool);
  if (cuts && !remove_bone(state, report.grid_from_tool, report)) return StepStatus::collision_failed;

  if (state.failed_over_tick == report.tick) {
    report.failed_over = true;
    report.hand_force_n.setZero();
    report.hand_torque_n_mm.setZero();
  }
  state.session_hash = hash_combine(state.session_hash, hash_of_cause(report));
  report.session_hash = state.session_hash;
  if (state.brick_sender != nullptr)
    state.brick_sender->send(state.bone.coverage.data(), report.tick, state.brick_budget);
  return is_finite(report) ? StepStatus::ok : StepStatus::not_finite;
}

}  // namespace ream::sim
