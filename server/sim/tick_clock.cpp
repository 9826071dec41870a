#include "sim/tick_clock.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

namespace ream::sim {
namespace {

constexpr int64_t spin_ns = 200'000;
constexpr int64_t hopeless_ns = 100'000'000;
constexpr int fifo_priority = 40;

}  // namespace

double TickClock::wait() noexcept {
  const int64_t wake_ns = next_ns_ - spin_ns;
  if (steady_ns() < wake_ns) {
    const timespec until{wake_ns / 1'000'000'000, wake_ns % 1'000'000'000};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
    }
  }
  int64_t now = steady_ns();
  while (now < next_ns_) now = steady_ns();
  const int64_t late_ns = now - next_ns_;
  next_ns_ = late_ns > hopeless_ns ? now + tick_ns : next_ns_ + tick_ns;
  return static_cast<double>(late_ns) * 1e-3;
}

bool make_realtime(Realtime mode) noexcept {
  if (mode == Realtime::off) return true;
  sched_param parameters{};
  parameters.sched_priority = fifo_priority;
  const bool granted = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
  const bool locked = ::mlockall(MCL_CURRENT) == 0;
  return mode == Realtime::attempt || (granted && locked);
}

}  // namespace ream::sim
