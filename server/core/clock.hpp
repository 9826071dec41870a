#pragma once
#include <chrono>
#include <cstdint>

namespace ream {

/// A tick is one millisecond of simulated time, however late it runs.
inline constexpr double tick_s = 1e-3, tick_ms = 1e3 * tick_s;
inline constexpr int64_t tick_ns = 1'000'000;
inline constexpr double ns_per_ms = 1.0e6;

using SteadyClock = std::chrono::steady_clock;

inline int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(SteadyClock::now().time_since_epoch()).count();
}

/// Microseconds since `start` (wall time, for measuring only; never decides anything).
inline double elapsed_us(SteadyClock::time_point start) {
  return std::chrono::duration<double, std::micro>(SteadyClock::now() - start).count();
}

}  // namespace ream
