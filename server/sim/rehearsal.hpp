#pragma once
#include "sim/state.hpp"

namespace ream::sim {

/// How long slow ticks of this session will take, us: contact and removal are rehearsed with the tool pressed
/// on the bone, without changing anything. The larger of the 99th percentile of the time that this thread
/// computed and the median of what passed on the clock (a device that others compute on), so that a busy
/// machine does not make it longer. Takes about 0.2 s; before the first tick.
double rehearsed_tick_us(const Model& model, State& state);

}  // namespace ream::sim
