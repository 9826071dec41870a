#pragma once
#include <string>

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
std::string refusal_words(const RealtimeGrant& grant, Realtime mode, int cpu);

}  // namespace ream::sim
