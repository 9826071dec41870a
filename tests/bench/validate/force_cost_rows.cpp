#include <algorithm>

#include "bench/validate/validate_parts.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "sim/approach.hpp"
#include "sim/guided_handle.hpp"
#include "sim/hand_output.hpp"
#include "sim/press.hpp"
#include "sim/step.hpp"
#include "support/small_run.hpp"

namespace ream::bench {
namespace {

constexpr double goal_us = 5.0;
constexpr double surface_mm = 17.0;
constexpr int ticks = 20000, warm_ticks = 1000;

/// All that the force room and its callers in the tick can do at once: oblique cutting, a nipple in its hole,
/// a scapula that gives way, friction, limits, vibration.
test::SmallRun everything_on() {
  voxel::BoneModel bone = test::slab({96, 96, 128}, 0.15, surface_mm, 1.2);
  case_::Plan plan = test::slab_plan(bone, surface_mm);
  plan.pilot_hole = case_::PilotHole{};
  plan.guide = case_::GuideKind::nipple;
  device::Script script = test::steady_push(52.0, 1.0);
  script.mount = device::chest_wall_mount;
  sim::Settings settings = test::SmallRun::settings(script, "cpu");
  sim::fit_to_device(device::device_profile("kuka-iiwa-14"), 0.0, settings);
  settings.start_up_ramp_s = 0.0;
  settings.feed.kind = force::FeedKind::oblique;
  settings.vibration.source = force::VibrationSource::synthesized;
  return {std::move(bone), plan, "ellipse 6,4 nipple 3,8", script, settings};
}

void turn_spindle(const sim::Model& model, sim::State& state) {
  const double full_rad_s = model.settings.feed.spindle_rad_s;
  state.spindle.advance(full_rad_s, full_rad_s, state.spindle_load);
}

/// One tick in the order of sim::step; returns the time of the parts that make force and motion, without
/// those that find contact and remove bone.
double force_us(const sim::Model& model, sim::State& state, const device::DeviceInput& input,
                record::TickReport& report) {
  report = {};
  report.tick = state.tick++;
  report.spindle_on = input.spindle_on;
  report.world_from_handle = input.world_from_handle;
  const auto begin = SteadyClock::now();
  device::DeviceInput allowed = input;
  allowed.world_from_handle = sim::guided(model, state, input.world_from_handle);
  turn_spindle(model, state);
  double spent_us = elapsed_us(begin);

  const sim::Approach found = sim::approach(model, state, allowed.world_from_handle);

  const auto pressing = SteadyClock::now();
  sim::ToolLoad load;
  if (found.sums.engaged() > 0) load = sim::press(model, state, found.sums, allowed, report);
  sim::add_guide(model, state, input.world_from_handle, allowed.world_from_handle, load, report);
  sim::move_bone(model, state, load, report.engaged);
  sim::keep_in_guide(model, state);
  state.thrust_n = report.thrust_n;
  state.spindle_load = load.spindle;
  spent_us += elapsed_us(pressing);

  report.grid_from_tool = quantised(state.world_from_grid.inverse() * state.world_from_tool);
  sim::remove_bone(state, report.grid_from_tool, report);

  const auto rendering = SteadyClock::now();
  report.vibration_g = state.vibration.next_g(sim::vibration_input(model, load, report));
  sim::render(model, state.output, state.world_from_tool, load, report);
  return spent_us + elapsed_us(rendering);
}

}  // namespace

std::vector<Row> force_cost_rows() {
  test::SmallRun run = everything_on();
  run.state.world_from_tool = run.model.world_from_plan * Pose{Mat3::Identity(), Vec3(0, 0, -0.5)};
  run.state.started = true;
  // It turns before it touches.
  for (int tick = 0; tick < warm_ticks; ++tick) turn_spindle(run.model, run.state);
  std::vector<double> us;
  record::TickReport report;
  int cutting_ticks = 0;
  for (int tick = 0; tick < warm_ticks + ticks; ++tick) {
    device::DeviceInput input;
    input.spindle_on = true;
    // Pressed in by 10 mm of spring and leaning: the guide's walls are at work too.
    input.world_from_handle = run.model.world_from_plan *
                              Pose{rotation_from_small_vector(Vec3(0.0, 0.05, 0.0)), Vec3(1.0, 0.0, 10.0)};
    const double spent_us = force_us(run.model, run.state, input, report);
    cutting_ticks += report.cutting ? 1 : 0;
    if (tick >= warm_ticks) us.push_back(spent_us);
  }
  if (cutting_ticks < ticks)
    throw Error(ErrorKind::unavailable, "the reamer lost the bone whose force was to be timed");
  std::sort(us.begin(), us.end());
  const auto at = [&us](double fraction) {
    return us[static_cast<size_t>(fraction * static_cast<double>(us.size() - 1))];
  };
  return {{"validate", "force in the tick, everything on, p50", at(0.5), 0.0, "us", goal_us},
          {"validate", "force in the tick, everything on, p99", at(0.99), 0.0, "us", goal_us}};
}

}  // namespace ream::bench
