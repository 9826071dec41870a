#include "sim/tick_trial.hpp"

#include <time.h>

#include <algorithm>
#include <array>

#include "core/clock.hpp"
#include "core/timing_histogram.hpp"

namespace ream::sim {
namespace {

constexpr double creep_mm = 1e-4;          ///< a look, more than reaming creeps in a tick
constexpr double deepest_search_mm = 5.0;  ///< past the planned entry
constexpr size_t bricks_a_look = 48;

constexpr int warm_ticks = 50, max_ticks = 1000;
constexpr double enough_us = 200'000.0;
/// Share of the points that are to be engaged; a tool that never has so many is rehearsed as deep as it goes.
/// Engineering choice.
constexpr double pressed_share = 0.1;

double thread_us() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

}  // namespace

TickTrial::TickTrial(const Model& model, const voxel::BoneModel& bone, const voxel::SolidCells& cells)
    : model_(model),
      cells_(cells),
      grid_from_plan_(bone.grid.world_from_grid.inverse() * model.world_from_plan) {
  const Vec3i at = bone.grid.voxel_at(grid_from_plan_.translation_mm) / voxel::brick_edge;
  const Vec3i last = bone.grid.brick_dims() - Vec3i::Ones();
  const uint32_t first = bone.grid.brick_index(at.cwiseMax(0).cwiseMin(last));
  for (uint32_t b = first; b < bone.grid.brick_count() && bricks_.size() < bricks_a_look; ++b)
    bricks_.push_back(b);
}

double TickTrial::pressed_depth_mm(collide::NarrowPhase& narrow_phase, double target_share) const {
  const auto target = static_cast<int64_t>(target_share * static_cast<double>(model_.contact_shell.size()));
  double depth_mm = -deepest_search_mm;
  for (; depth_mm < deepest_search_mm; depth_mm += model_.thin_step_mm) {
    collide::ContactSums sums;
    if (!look(narrow_phase, depth_mm, sums)) break;
    if (sums.engaged() >= target) break;
  }
  return depth_mm;
}

double TickTrial::tick_us(Backend& backend, double depth_mm, int number) const {
  const auto start = SteadyClock::now();
  collide::ContactSums sums;
  const bool ok =
      look(*backend.narrow_phase, depth_mm + creep_mm * number, sums) && pass_over_bricks(backend);
  return ok ? elapsed_us(start) : -1.0;
}

bool TickTrial::look(collide::NarrowPhase& narrow_phase, double depth_mm, collide::ContactSums& sums) const {
  const QuantisedPose pose = quantised(grid_from_plan_ * Pose{Mat3::Identity(), Vec3(0.0, 0.0, depth_mm)});
  const collide::Voi voi = collide::broad_phase(cells_.bounds_mm(), model_.tool_box_tool, dequantised(pose),
                                                model_.contact_reach_mm);
  return narrow_phase.contact(pose, voi, sums);
}

/// The cutting body a metre away: the bricks are gone through and nothing changes.
bool TickTrial::pass_over_bricks(Backend& backend) const {
  if (backend.removal == nullptr) return true;
  const QuantisedPose away = quantised({Mat3::Identity(), Vec3(0.0, 0.0, 1000.0)});
  std::array<collide::BrickOutcome, bricks_a_look> outcomes;
  collide::RemovalSums sums;
  return backend.removal->cut(away, bricks_, {outcomes.data(), bricks_.size()}, sums);
}

double rehearsed_tick_us(const Model& model, State& state) {
  const TickTrial trial(model, state.bone, state.cells);
  const double depth_mm = trial.pressed_depth_mm(*state.backend.narrow_phase, pressed_share);
  TimingHistogram computed, passed;
  double total_us = 0.0;
  for (int i = 0; i < max_ticks && total_us < enough_us; ++i) {
    const double before_us = thread_us();
    const double tick_us = trial.tick_us(state.backend, depth_mm, i);
    if (tick_us < 0.0) break;
    total_us += tick_us;
    if (i < warm_ticks) continue;
    computed.add(thread_us() - before_us);
    passed.add(tick_us);
  }
  return std::max(computed.summary().p99_us, passed.summary().p50_us);
}

}  // namespace ream::sim
