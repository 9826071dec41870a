#pragma once
#include "sim/haptic_loop.hpp"

namespace ream::bench {

/// The haptic loop with nothing to do, for that many seconds: a device that says and does nothing, a tool
/// that rests beside a pinch of bone. What it cannot do in time, no reaming can. `busy_us` of each tick it
/// only looks at the clock: a host that takes a virtual processor away takes it from those who use it.
sim::LoopHealth run_empty_loop(double seconds, sim::Realtime realtime, int cpu, double busy_us);

}  // namespace ream::bench
