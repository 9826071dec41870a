#include "sim/step.hpp"

#include <cmath>

#include "core/clock.hpp"
#include "record/session_hash.hpp"
#include "sim/approach.hpp"
#include "sim/guided_handle.hpp"
#include "sim/press.hpp"

namespace ream::sim {
namespace {

/// Where an admittance device's virtual mass would fly in this tick if nothing held it.
Pose flown(const Model& model, const State& state, const device::DeviceInput& input) {
  const Mat3 tool_from_world = state.world_from_tool.rotation.transpose();
  const force::Wrench hand{tool_from_world * input.hand_force_n, tool_from_world * input.hand_torque_n_mm};
  return moved(state.world_from_tool, force::free_flight(*model.virtual_mass, state.tool_twist, hand));
}

/// What the handle's pose is in this tick: sensed or given, or for an admittance device the virtual mass'
/// own.
Pose world_from_handle(const Model& model, const State& state, const device::DeviceInput& input) {
  if (!model.virtual_mass || !state.started || state.handle_given) return input.world_from_handle;
  return input.paused ? state.world_from_tool : flown(model, state, input);
}

/// Follows the handle as far as the guide lets it, feels bone and moves against it, or with it.
bool move_tool(const Model& model, State& state, const device::DeviceInput& input, ToolLoad& load,
               TickReport& report) {
  const Pose before = state.world_from_tool;
  state.tick_from_mm = before.translation_mm;
  device::DeviceInput allowed = input;
  allowed.world_from_handle = guided(model, state, input.world_from_handle);
  const double ahead_mm = (allowed.world_from_handle.translation_mm - before.translation_mm).norm();
  const double travel_mm = state.slips ? max_travel_mm(model, state, ahead_mm) : ahead_mm;
  state.slips = ahead_mm > travel_mm;
  const Approach found =
      approach(model, state,
               state.slips ? between(before, allowed.world_from_handle, travel_mm / ahead_mm)
                           : allowed.world_from_handle);
  if (!found.ok) return false;
  if (found.sums.engaged() > 0) {
    load = press(model, state, found.sums, allowed, report);
    state.slips = true;
  } else {
    const force::Vec6 way = handle_minus_tool(before, state.world_from_tool);
    for (size_t i = 0; i < 6; ++i) state.tool_twist[i] = way[i] / tick_s;
    state.normal_force_n = state.edge_load_n = 0.0;
  }
  add_guide(model, state, input.world_from_handle, allowed.world_from_handle, load, report);
  move_bone(model, state, load, report.engaged);
  // It accelerates the drive, and is nothing to the bone.
  if (state.slips && !report.engaged) add_slip(model, state, allowed.world_from_handle, load);
  keep_in_guide(model, state);
  state.tool_speed_mm_s = (state.world_from_tool.translation_mm - before.translation_mm).norm() / tick_s;
  return true;
}

/// Below this share the trigger is at rest: hands and sensors are not quiet.
constexpr double min_trigger_share = 0.05;

/// Lets the drive follow trigger and load. In a pause it keeps its speed, or runs down once it is let go.
void turn_spindle(const Model& model, State& state, const device::DeviceInput& input) {
  if (input.paused && input.spindle_on) return;
  const double full_rad_s = model.settings.feed.spindle_rad_s;
  double pressed = input.spindle_on ? input.drive.trigger / 255.0 : 0.0;
  if (pressed < min_trigger_share) pressed = 0.0;
  state.spindle.advance((input.drive.reversed ? -pressed : pressed) * full_rad_s, full_rad_s,
                        state.spindle_load);
}

void tell_of_spindle(State& state, const ToolLoad& load, TickReport& report) {
  state.spindle_load = load.spindle;
  report.spindle_speed_rad_s = state.spindle.speed_rad_s();
  report.spindle_torque_n_mm = state.spindle.motor_torque_n_mm();
  report.stalled = state.spindle.is_stalled();
}

constexpr double w_per_n_mm_s = 1e-3;

/// Warms the bone under the reamer by what the spindle has put into it. Nothing else depends on it.
void heat_bone(const Model& model, State& state, const ToolLoad& load, TickReport& report) {
  const Pose tool = dequantised(report.grid_from_tool);
  force::HeatTick tick;
  tick.power_w = report.engaged
                     ? std::abs(state.spindle.bone_torque_n_mm() * report.spindle_speed_rad_s) * w_per_n_mm_s
                     : 0.0;
  tick.area_mm2 = load.area_mm2;
  if (report.cutting) tick.advance_mm = report.feed_rate_mm_s * tick_s;
  tick.irrigated = report.drive.irrigating;
  tick.apex_mm = tool.translation_mm;
  tick.axis = tool.rotation.col(2);
  if (!report.paused) state.heat.add(model.settings.heat, tick);
  report.surface_temperature_c = state.heat.surface_c(model.settings.heat);
}

bool is_finite(const TickReport& r) {
  return r.hand_force_n.allFinite() && r.hand_torque_n_mm.allFinite() &&
         r.world_from_tool.translation_mm.allFinite() && r.world_from_tool.rotation.allFinite() &&
         std::isfinite(r.thrust_n) && std::isfinite(r.spindle_speed_rad_s) &&
         std::isfinite(r.surface_temperature_c);
}

/// Recorded poses reach to 2.1 m; scanners' tables put bones as far as this from the origin, mm.
constexpr double max_coordinate_mm = 2000.0;

bool is_usable(const Pose& pose) {
  return pose.rotation.allFinite() && (pose.translation_mm.array().abs() < max_coordinate_mm).all();
}

bool is_finite(const device::DeviceInput& input) {
  return is_usable(input.world_from_handle) && input.hand_force_n.allFinite() &&
         input.hand_torque_n_mm.allFinite();
}

}  // namespace

StepStatus step(const Model& model, State& state, const device::DeviceInput& raw_input,
                TickReport& report) noexcept {
  report = {};
  if (!is_finite(raw_input)) return StepStatus::not_finite;
  report.tick = state.tick++;
  report.spindle_on = raw_input.spindle_on;
  report.paused = raw_input.paused;
  report.stale = raw_input.stale;
  report.drive = raw_input.drive;
  const Pose handle = world_from_handle(model, state, raw_input);
  if (!is_usable(handle)) return StepStatus::not_finite;
  report.world_from_handle_q = quantised(handle);
  device::DeviceInput input = raw_input;
  input.world_from_handle = dequantised(report.world_from_handle_q);
  report.world_from_handle = input.world_from_handle;
  if (!state.started) state.world_from_tool = input.world_from_handle;
  state.started = true;

  turn_spindle(model, state, input);
  ToolLoad load;
  if (input.paused)
    state.tool_twist = {}, state.tool_speed_mm_s = 0.0;
  else if (!move_tool(model, state, input, load, report))
    return StepStatus::collision_failed;
  state.thrust_n = report.thrust_n;
  if (!input.paused) tell_of_spindle(state, load, report);
  report.world_from_tool = state.world_from_tool;
  report.world_from_bone_rest = state.world_from_bone_rest;
  const Pose grid_from_tool = state.world_from_grid.inverse() * state.world_from_tool;
  if (!is_usable(grid_from_tool)) return StepStatus::not_finite;
  report.grid_from_tool = quantised(grid_from_tool);

  if (!load.cuts) state.schedule.pass(report.grid_from_tool);
  if (load.cuts && !remove_bone(state, report.grid_from_tool, report)) return StepStatus::collision_failed;

  heat_bone(model, state, load, report);
  report.failed_over = state.failed_over_tick == report.tick;
  report.vibration_g = state.vibration.next_g(vibration_input(model, load, report));
  render(model, state.output, state.world_from_tool, load, report);
  state.session_hash =
      record::hash_after(state.session_hash, report.tick, record::cause_flags(report), report.grid_from_tool);
  report.session_hash = state.session_hash;
  if (state.brick_sender != nullptr) {
    state.brick_sender->send(state.bone.coverage.data(), report.tick, state.brick_budget);
    report.bricks_waiting = static_cast<uint32_t>(state.brick_sender->pending());
  }
  return is_finite(report) ? StepStatus::ok : StepStatus::not_finite;
}

}  // namespace ream::sim
