#include "sim/tick_clock.hpp"

#include <time.h>

#include <algorithm>

namespace ream::sim {
namespace {

constexpr int64_t hopeless_ns = 100'000'000;
constexpr double step_us = 1.0, wanted_in_time = 0.99;

}  // namespace

void WakeMargin::note(double late_us) noexcept {
  // A running estimate of that quantile: in balance when so many wake-ups are not later.
  const double change_us = late_us > margin_us_ ? wanted_in_time * step_us : (wanted_in_time - 1.0) * step_us;
  margin_us_ = std::clamp(margin_us_ + change_us, least_us, most_us);
}

double TickClock::wait() noexcept {
  const int64_t wake_ns = next_ns_ - margin_.ns();
  int64_t now = steady_ns();
  if (now < wake_ns) {
    const timespec until{wake_ns / 1'000'000'000, wake_ns % 1'000'000'000};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
    }
    now = steady_ns();
    margin_.note(static_cast<double>(now - wake_ns) * 1e-3);
  }
  while (now < next_ns_) now = steady_ns();
  const int64_t late_ns = now - next_ns_;
  next_ns_ = late_ns > hopeless_ns ? now + tick_ns : next_ns_ + tick_ns;
  return static_cast<double>(late_ns) * 1e-3;
}

}  // namespace ream::sim
