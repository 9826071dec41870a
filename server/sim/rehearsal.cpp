#include "sim/rehearsal.hpp"

#include <time.h>

#include <algorithm>

#include "core/timing_histogram.hpp"
#include "sim/tick_trial.hpp"

namespace ream::sim {
namespace {

constexpr int warm_ticks = 50, most_ticks = 1000;
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

double rehearsed_tick_us(const Model& model, State& state) {
  const TickTrial trial(model, state.bone, state.cells);
  const double depth_mm = trial.pressed_depth_mm(*state.backend.narrow_phase, pressed_share);
  TimingHistogram computed, passed;
  double total_us = 0.0;
  for (int i = 0; i < most_ticks && total_us < enough_us; ++i) {
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
