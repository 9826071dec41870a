#pragma once
#include <cstdint>

#include "core/clock.hpp"

namespace ream::sim {

/// How long before the tick to wake up, so that the kernel's lateness in waking a thread (1 % of wake-ups
/// excepted) is over before the tick: it follows what the wake-ups were like, up 1 us for each that was
/// later than expected, down 10 us a second while none is.
class WakeMargin {
 public:
  /// A wake-up came so late, us.
  void note(double late_us) noexcept;
  int64_t ns() const noexcept { return static_cast<int64_t>(margin_us_ * 1e3); }

  /// A fifth of the time at most goes into spinning, far from the 95 % at which the kernel holds real-time
  /// threads back.
  static constexpr double least_us = 20.0, most_us = 200.0;

 private:
  double margin_us_ = most_us;
};

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
  WakeMargin margin_;
};

}  // namespace ream::sim
