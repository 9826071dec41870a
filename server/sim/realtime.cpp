#include "sim/realtime.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <time.h>

#include <algorithm>

#include "core/process_memory.hpp"

namespace ream::sim {
namespace {

/// Ordinary threads may be woken up to 50 us late so that the kernel can bundle timers; ours may not.
constexpr unsigned long timer_slack_ns = 1;

bool pin_to(int cpu) noexcept {
  if (cpu >= CPU_SETSIZE) return false;
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(static_cast<size_t>(cpu), &only);
  return ::pthread_setaffinity_np(::pthread_self(), sizeof only, &only) == 0;
}

constexpr int64_t hopeless_ns = 100'000'000;
constexpr double step_us = 1.0, target_in_time = 0.99;

}  // namespace

RealtimeGrant ask_for_realtime(Realtime mode, int cpu) noexcept {
  RealtimeGrant grant;
  if (mode == Realtime::off) return grant;
  ::prctl(PR_SET_TIMERSLACK, timer_slack_ns);
  sched_param parameters{};
  parameters.sched_priority = loop_fifo_priority;
  grant.fifo = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0;
  // All that the loop touches is there by now. Memory that comes later is not locked on purpose: it would be
  // what others read and build, up to gigabytes that the kernel could not put aside any more, and where
  // locked memory is limited, allocations of any thread would fail.
  grant.locked = lock_memory();
  if (cpu >= 0 && pin_to(cpu)) grant.cpu = cpu;
  return grant;
}

std::string refusal_message(const RealtimeGrant& grant, Realtime mode, int cpu) {
  if (mode == Realtime::off) return "";
  std::string refused, remedy;
  const auto add = [&](const std::string& what, const std::string& what_to_do) {
    refused += (refused.empty() ? "" : " and ") + what;
    remedy += (remedy.empty() ? "" : ", ") + what_to_do;
  };
  if (!grant.fifo) add("real-time priority", "give the program CAP_SYS_NICE");
  if (!grant.locked) add("locking its memory", "allow it unlimited locked memory (ulimit -l, CAP_IPC_LOCK)");
  if (cpu >= 0 && grant.cpu != cpu)
    add("CPU " + std::to_string(cpu), "let it run on that CPU (taskset, cpuset)");
  if (refused.empty()) return "";
  return "the haptic loop was refused " + refused + "; " + remedy + ", or use --realtime try";
}

void WakeMargin::note(double late_us) noexcept {
  // A running estimate of that quantile: in balance when so many wake-ups are not later.
  const double change_us = late_us > margin_us_ ? target_in_time * step_us : (target_in_time - 1.0) * step_us;
  margin_us_ = std::clamp(margin_us_ + change_us, min_us, max_us);
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
