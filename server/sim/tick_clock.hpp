#pragma once
#include <cstdint>

#include "core/clock.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::sim {

/// Absolute 1 kHz schedule: sleeps until shortly before the tick and spins the rest (a pure real-time spin
/// would be throttled by the kernel). A loop that fell behind by more than 100 ms starts a new schedule
/// instead of racing.
class TickClock {
 public:
  TickClock() : next_ns_(steady_ns() + tick_ns) {}
  /// Waits for the next tick; returns its lateness in us.
  double wait() noexcept;

 private:
  int64_t next_ns_;
};

/// Real-time priority and locked memory for the calling thread. False when `mode` is require and it was
/// refused.
bool make_realtime(Realtime mode) noexcept;

}  // namespace ream::sim
