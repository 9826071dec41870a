#include "sim/watchdogs.hpp"

#include <pthread.h>
#include <sched.h>

#include "core/signal_handlers.hpp"

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

LoopGuard::LoopGuard(device::HapticDevice& device, std::chrono::milliseconds limit, bool realtime,
                     int64_t (*now_ns)())
    : device_(device),
      now_ns_(now_ns),
      limit_ns_(std::chrono::nanoseconds(limit).count()),
      thread_(start_thread([this, realtime] { watch(realtime); })) {}

LoopGuard::~LoopGuard() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  leaving_changed_.notify_all();
  thread_.join();
}

bool LoopGuard::beat() noexcept {
  beat_ns_.store(now_ns_(), std::memory_order_release);
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
  const int64_t still_ns = now_ns_() - beat_ns;
  if (beat_ns == 0 || ended_.load(std::memory_order_acquire)) return;
  if (!tripped()) {
    if (still_ns <= limit_ns_.load(std::memory_order_acquire)) return;
    device_.take_force_away();
    tripped_beat_ns_ = beat_ns;
  }
  if (beat_ns == tripped_beat_ns_) stood_still_ms_.store(still_ns / 1'000'000, std::memory_order_release);
}

using device::LinkState;

LinkState link_state(double age_ms, const device::StaleLimits& limits) noexcept {
  // An age that is not a number is as good as none.
  if (!(age_ms < limits.lost_ms)) return LinkState::lost;
  if (age_ms >= limits.fade_ms) return LinkState::fading;
  return age_ms >= limits.hold_ms ? LinkState::held : LinkState::fresh;
}

LinkState PoseWatchdog::judge(uint32_t tick, device::DeviceInput& input) noexcept {
  LinkState state = link_state(input.age_ms, limits_);
  if (state == LinkState::fading && state_ == LinkState::lost) state = LinkState::lost;
  if (state == LinkState::lost && state_ != LinkState::lost && been_there_) {
    ++losses_;
    lost_tick_ = tick;
  }
  been_there_ |= state != LinkState::lost;
  state_ = state;
  if (state >= LinkState::fading) {
    input.stale = true;
    input.hand_force_n = input.hand_torque_n_mm = Vec3::Zero();
  }
  input.paused |= state == LinkState::lost;
  return state;
}

}  // namespace ream::sim
