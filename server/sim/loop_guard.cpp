#include "sim/loop_guard.hpp"

#include <pthread.h>
#include <sched.h>

#include "core/clock.hpp"

namespace ream::sim {
namespace {

constexpr std::chrono::milliseconds look_every{5};
constexpr int guard_priority = 60;

void ask_for_priority() noexcept {
  sched_param parameters{};
  parameters.sched_priority = guard_priority;
  // Where it is refused, the loop has none either.
  ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
}

}  // namespace

LoopGuard::LoopGuard(device::HapticDevice& device, std::chrono::milliseconds limit, bool realtime)
    : device_(device),
      limit_ns_(std::chrono::nanoseconds(limit).count()),
      thread_([this, realtime] { watch(realtime); }) {}

LoopGuard::~LoopGuard() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  leaving_changed_.notify_all();
  thread_.join();
}

bool LoopGuard::beat() noexcept {
  beat_ns_.store(steady_ns(), std::memory_order_release);
  return !tripped();
}

void LoopGuard::closing(std::chrono::milliseconds longer) noexcept {
  limit_ns_.fetch_add(std::chrono::nanoseconds(longer).count(), std::memory_order_acq_rel);
  beat();
}

void LoopGuard::watch(bool realtime) {
  if (realtime) ask_for_priority();
  std::unique_lock lock(mutex_);
  while (!leaving_changed_.wait_for(lock, look_every, [this] { return leaving_; })) look();
}

void LoopGuard::look() noexcept {
  const int64_t beat_ns = beat_ns_.load(std::memory_order_acquire);
  if (beat_ns == 0 || ended_.load(std::memory_order_acquire)) return;
  const int64_t still_ns = steady_ns() - beat_ns;
  if (!tripped()) {
    if (still_ns <= limit_ns_.load(std::memory_order_acquire)) return;
    device_.take_force_away();
    tripped_beat_ns_ = beat_ns;
  }
  if (beat_ns == tripped_beat_ns_) stood_still_ms_.store(still_ns / 1'000'000, std::memory_order_release);
}

}  // namespace ream::sim
