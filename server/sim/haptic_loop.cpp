#include "sim/haptic_loop.hpp"

#include <system_error>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "sim/tick_clock.hpp"

namespace ream::sim {
namespace {

constexpr uint32_t publish_every_ticks = 500;
constexpr std::chrono::milliseconds look_for_end{1};

/// Leaves the device without force and closed, whatever happens in between.
class DeviceGuard {
 public:
  explicit DeviceGuard(device::HapticDevice& device) : device_(device) {}
  ~DeviceGuard() {
    device_.write({});
    device_.close();
  }
  DeviceGuard(const DeviceGuard&) = delete;
  DeviceGuard& operator=(const DeviceGuard&) = delete;

 private:
  device::HapticDevice& device_;
};

LoopEnd end_of(StepStatus status) {
  switch (status) {
    case StepStatus::ok:
      return LoopEnd::running;
    case StepStatus::collision_failed:
      return LoopEnd::collision_failed;
    case StepStatus::not_finite:
      return LoopEnd::not_finite;
  }
  return LoopEnd::not_finite;
}

}  // namespace

std::string to_words(LoopEnd end) {
  switch (end) {
    case LoopEnd::device_fault:
      return "The haptic device stopped answering; check its cable and power, then start a new session.";
    case LoopEnd::collision_failed:
      return "The OpenCL device failed; start again with --backend cpu.";
    case LoopEnd::not_finite:
      return "The handle was more than 2 m from the origin, or a force was not a number; the "
             "force was set to zero and the session ended.";
    case LoopEnd::stood_still:
      return "The haptic loop stood still and the force was taken away; start a new session, on a computer "
             "with "
             "less to do.";
    case LoopEnd::followers_late:
      return "The recording could not keep up with the loop; check the disk, then start a new session.";
    case LoopEnd::running:
    case LoopEnd::finished:
    case LoopEnd::stopped:
      return "";
  }
  return "";
}

std::string failover_words(int64_t tick) {
  return "the OpenCL device failed in tick " + std::to_string(tick) +
         "; the session goes on with the C++ form and the same results";
}

HapticLoop::HapticLoop(const Model& model, State& state, device::HapticDevice& device,
                       SpscRing<TickReport>& reports, LoopOptions options)
    : model_(model),
      state_(state),
      device_(device),
      reports_(reports),
      options_(options),
      watchdog_(device.traits().stale) {
  if (options.wall_clock)
    guard_.emplace(device, LoopGuard::limit_for(device.traits()), options.realtime != Realtime::off);
}

HapticLoop::~HapticLoop() {
  stop();
  if (thread_.joinable()) thread_.join();
}

void HapticLoop::start() {
  device_.open();
  std::atomic<int> granted{-1};
  try {
    thread_ = std::thread([this, &granted] {
      const bool usable = !options_.wall_clock || make_realtime(options_.realtime);
      granted.store(usable, std::memory_order_release);
      granted.notify_one();
      if (usable) loop();
    });
  } catch (const std::system_error& e) {
    device_.close();
    throw Error(ErrorKind::unavailable,
                std::string("no thread can be started for the haptic loop: ") + e.what());
  }
  granted.wait(-1, std::memory_order_acquire);
  if (granted.load(std::memory_order_acquire) == 1) return;
  thread_.join();
  device_.close();
  throw Error(
      ErrorKind::unavailable,
      "real-time scheduling was refused; give the program CAP_SYS_NICE and unlimited locked memory, or use "
      "--realtime try");
}

LoopEnd HapticLoop::run() {
  device_.open();
  loop();
  return health().end;
}

void HapticLoop::stop() noexcept {
  request_stop();
  while (thread_.joinable() && !ended() && stood_still_ms() == 0) std::this_thread::sleep_for(look_for_end);
  if (thread_.joinable() && ended()) thread_.join();
}

LoopHealth HapticLoop::health() noexcept {
  published_.take(last_seen_);
  return last_seen_;
}

void HapticLoop::loop() noexcept {
  LoopEnd end = LoopEnd::running;
  {
    const DeviceGuard guard(device_);
    TickClock clock;
    device::DeviceInput input;
    while (end == LoopEnd::running) {
      const double lateness_us = options_.wall_clock ? clock.wait() : 0.0;
      if (stop_.load(std::memory_order_relaxed)) {
        end = stood_still_ms() > 0 ? LoopEnd::stood_still : LoopEnd::stopped;
        break;
      }
      if (guard_ && !guard_->beat()) {
        end = LoopEnd::stood_still;
        break;
      }
      end = one_tick(input, lateness_us);
      if (state_.tick % publish_every_ticks == 0) publish(end);
    }
  }
  if (guard_) guard_->end();
  publish(end);
  ended_.store(true, std::memory_order_release);
}

LoopEnd HapticLoop::one_tick(device::DeviceInput& input, double lateness_us) noexcept {
  const auto start = SteadyClock::now();
  const device::DeviceStatus read = device_.read(input);
  if (read == device::DeviceStatus::finished) return LoopEnd::finished;
  if (read != device::DeviceStatus::ok) return LoopEnd::device_fault;

  device::DeviceInput trusted = input;
  const device::LinkState link = watchdog_.judge(state_.tick, trusted);
  TickReport report;
  const StepStatus status = step(model_, state_, trusted, report);
  report.link = link;
  const double step_us = elapsed_us(start);
  report.timing = {lateness_us, 0.0, step_us, 0.0};
  black_box_.remember(report, step_us, lateness_us);
  if (status != StepStatus::ok) return end_of(status);
  const device::DeviceStatus written = device_.write(output_of(report));

  tick_us_.add(step_us);
  lateness_us_.add(lateness_us);
  if (lateness_us >= 1000.0) ++missed_;
  // Bone may have been cut, so the tick is told even when it is the last.
  const bool told = push(report);
  if (written != device::DeviceStatus::ok) return LoopEnd::device_fault;
  return told ? LoopEnd::running : LoopEnd::followers_late;
}

bool HapticLoop::push(const TickReport& report) noexcept {
  if (options_.wall_clock) return reports_.try_push(report);
  // Virtual time may wait for its followers.
  while (!reports_.try_push(report)) {
    if (stop_.load(std::memory_order_relaxed)) return true;
    std::this_thread::yield();
  }
  return true;
}

void HapticLoop::publish(LoopEnd end) noexcept {
  published_.store({end, state_.tick, missed_, state_.failed_over_tick, tick_us_.summary(),
                    lateness_us_.summary(), watchdog_.state(), watchdog_.losses(), watchdog_.lost_tick()});
}

}  // namespace ream::sim
