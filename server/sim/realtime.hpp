#pragma once
#include <cstdint>
#include <string>

#include "core/clock.hpp"

namespace ream::sim {

/// How the loop gets its scheduling: real-time priority and locked memory demanded, tried, or left alone.
enum class Realtime { require, attempt, off };

/// SCHED_FIFO priorities of the haptic loop, and of the threads that exchange its forces with a device.
inline constexpr int loop_fifo_priority = 40, driver_fifo_priority = loop_fifo_priority - 1;

/// What the kernel gave the calling thread.
struct RealtimeGrant {
  bool fifo = false;    ///< SCHED_FIFO: nothing ordinary runs before it
  bool locked = false;  ///< the memory that the process has so far stays in place
  int cpu = -1;         ///< the only CPU it runs on; -1: any
};

/// Asks for real-time priority and locked memory, and for `cpu` if it is not negative, for the calling thread
/// only: threads that it starts later are not its heirs, so it should start none. Nothing is asked for when
/// `mode` is off. Takes what it gets; never throws.
RealtimeGrant ask_for_realtime(Realtime mode, int cpu) noexcept;

/// One sentence about everything that was asked for and refused, and what to do; empty when there is nothing
/// of the kind.
std::string refusal_message(const RealtimeGrant& grant, Realtime mode, int cpu);

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
  static constexpr double min_us = 20.0, max_us = 200.0;

 private:
  double margin_us_ = max_us;
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
