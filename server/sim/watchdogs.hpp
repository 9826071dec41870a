#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/clock.hpp"
#include "device/haptic_device.hpp"

namespace ream::sim {

/// Watches a haptic loop from a thread of its own. A loop that has not begun a tick for longer than `limit`
/// is dead or stuck: the guard takes the force away from its device, once and for good, and says so.
class LoopGuard {
 public:
  /// After this long a device that somebody holds must not render an old force any more; of one that nobody
  /// holds, or that lets go by itself before, only a loop that does not come back is worth a word.
  static constexpr std::chrono::milliseconds held_limit{50}, harmless_limit{2000};
  static std::chrono::milliseconds limit_for(const device::DeviceTraits& traits) {
    const bool lets_go = traits.force_expires_ms < static_cast<double>(held_limit.count());
    return traits.simulated || lets_go ? harmless_limit : held_limit;
  }

  /// Watches from the first beat on. `device` outlives the guard. `realtime`: with a real-time priority above
  /// the loop's, where it is granted, so that a loop that spins without end cannot keep the guard from its
  /// work. `now_ns`: the clock by which the loop is judged; both threads ask it. Throws std::system_error
  /// without a thread.
  LoopGuard(device::HapticDevice& device, std::chrono::milliseconds limit, bool realtime,
            int64_t (*now_ns)() = steady_ns);
  ~LoopGuard();
  LoopGuard(const LoopGuard&) = delete;
  LoopGuard& operator=(const LoopGuard&) = delete;

  /// The loop begins a tick; wait-free. False: it has stood still, and must end.
  bool beat() noexcept;
  /// The loop is about to close its device, which may take so much longer than a tick; wait-free.
  void closing(std::chrono::milliseconds longer) noexcept;
  /// The loop has ended in order: nothing is watched any more.
  void end() noexcept { ended_.store(true, std::memory_order_release); }

  /// For how long the loop stood still before the force was taken away and since, ms; any thread. 0: it has
  /// not.
  int64_t stood_still_ms() const noexcept { return stood_still_ms_.load(std::memory_order_acquire); }

 private:
  bool tripped() const noexcept { return stood_still_ms() > 0; }
  void watch(bool realtime);
  void look() noexcept;

  device::HapticDevice& device_;
  int64_t (*const now_ns_)();
  std::atomic<int64_t> limit_ns_;
  std::atomic<int64_t> beat_ns_{0};
  std::atomic<bool> ended_{false};
  std::atomic<int64_t> stood_still_ms_{0};
  int64_t tripped_beat_ns_ = -1;  ///< the last beat before the loop stood still
  std::mutex mutex_;
  std::condition_variable leaving_changed_;
  bool leaving_ = false;
  std::thread thread_;
};

/// What may still be done with what a device said, by the age of it.
device::LinkState link_state(double age_ms, const device::StaleLimits& limits) noexcept;

/// Stands between a device and the step. Up to StaleLimits::hold_ms the last pose is as good
/// as a new one, and up to fade_ms it is held. From there on the input is stale: the force on the hand fades
/// out, and the hand's own force counts for nothing. From lost_ms on the session rests, as after a pause,
/// until a pose comes that is not stale.
class PoseWatchdog {
 public:
  explicit PoseWatchdog(const device::StaleLimits& limits) : limits_(limits) {}

  /// Judges what was read for tick `tick`, and marks `input` as stale or paused.
  device::LinkState judge(uint32_t tick, device::DeviceInput& input) noexcept;

  device::LinkState state() const { return state_; }
  /// How often the device was lost after it had once been there, and when last; -1: never.
  uint64_t losses() const { return losses_; }
  int64_t lost_tick() const { return lost_tick_; }

 private:
  device::StaleLimits limits_;
  device::LinkState state_ = device::LinkState::lost;
  uint64_t losses_ = 0;
  int64_t lost_tick_ = -1;
  bool been_there_ = false;
};

}  // namespace ream::sim
