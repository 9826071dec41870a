#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "core/clock.hpp"
#include "core/latest_slot.hpp"
#include "core/spsc_ring.hpp"
#include "device/haptic_device.hpp"
#include "sim/black_box.hpp"
#include "sim/loop_health.hpp"
#include "sim/realtime.hpp"
#include "sim/step.hpp"
#include "sim/watchdogs.hpp"

namespace ream::sim {

struct LoopOptions {
  bool wall_clock = true;  ///< false: virtual time, each tick as soon as the last is done
  Realtime realtime = Realtime::attempt;
  int cpu = -1;                           ///< that the loop's thread is to run on; -1: any
  int64_t (*guard_now_ns)() = steady_ns;  ///< the clock of its LoopGuard
};

/// The 1 kHz loop: read, compute, check, limit, write. In virtual time it runs the same ticks without
/// waiting. Every way out of it writes zero force and closes the device. One loop per State; the reports ring
/// has one consumer.
class HapticLoop {
 public:
  HapticLoop(const Model& model, State& state, device::HapticDevice& device, SpscRing<TickReport>& reports,
             LoopOptions options);
  /// Stops. A loop that stands still is waited for; where it does not come back within 10 s, its thread can
  /// be neither ended nor left behind: the process ends (device::end_process_without_force).
  ~HapticLoop();
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;

  /// The CPU that start() is to use, in place of the options'; before it.
  void pin_to(int cpu) noexcept { options_.cpu = cpu; }
  /// Opens the device and starts the thread. Errors: those of open(); unavailable when real time is required
  /// and any part of it refused.
  void start();
  /// Asks the loop to end; from any thread.
  void request_stop() noexcept { stop_.store(true, std::memory_order_relaxed); }
  /// From its next tick on the session is paused as by the device's own button, or no longer; any thread.
  void pause(bool paused) noexcept { paused_.store(paused, std::memory_order_relaxed); }
  /// Asks the loop to end and waits for it, 10 s at most, and not for one that stands still. Safe to call
  /// twice.
  void stop() noexcept;
  /// Runs the whole loop on the calling thread instead of start().
  LoopEnd run();

  /// True once the loop has ended (all reports are in the ring then).
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  /// How long a wall-clock loop has stood still, ms, so that its device was left without force (LoopGuard);
  /// 0: it has not. Any thread.
  int64_t stood_still_ms() const noexcept { return guard_ ? guard_->stood_still_ms() : 0; }
  /// Newest health; one reader thread.
  LoopHealth health() noexcept;
  /// Whole histograms and black box; only after ended().
  const BlackBox& black_box() const { return black_box_; }

 private:
  std::string refusal() const;
  void loop() noexcept;
  LoopEnd one_tick(device::DeviceInput& input, double lateness_us) noexcept;
  bool force_expired() const noexcept;
  LoopEnd compute_and_write(const device::DeviceInput& input, bool held, TickTiming& timing) noexcept;
  void count(const TickTiming& timing) noexcept;
  bool push(const TickReport& report) noexcept;
  void summarise(uint32_t which) noexcept;
  void publish(LoopEnd end) noexcept;

  const Model& model_;
  State& state_;
  device::HapticDevice& device_;
  SpscRing<TickReport>& reports_;
  LoopOptions options_;
  std::thread thread_;
  std::atomic<bool> stop_{false}, ended_{false}, paused_{false};
  LatestSlot<LoopHealth> published_;
  LoopHealth last_seen_;
  TimingHistogram tick_us_, lateness_us_, read_us_, step_us_, write_us_;
  LoopHealth health_;  ///< the loop's own
  const double force_expires_ms_;
  int64_t written_ns_ = 0;  ///< when the device was last told a force; 0: never
  bool let_go_ = false;     ///< by the device itself, in the last tick
  BlackBox black_box_;
  PoseWatchdog watchdog_;
  std::optional<LoopGuard> guard_;  ///< of a wall-clock loop
};

}  // namespace ream::sim
