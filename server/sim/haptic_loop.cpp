#include "sim/haptic_loop.hpp"

#include <system_error>

#include "core/error.hpp"
#include "core/signal_handlers.hpp"
#include "device/crash_guard.hpp"
#include "device/haptic_device.hpp"
#include "sim/realtime.hpp"

namespace ream::sim {
namespace {

constexpr uint32_t publish_every_ticks = 500;
constexpr uint32_t summaries = 5;
constexpr std::chrono::milliseconds look_for_end{1};
/// What has not come back by then does not: drivers give up after a second or two.
constexpr std::chrono::seconds max_return_time{10};

template <typename Condition>
bool comes_true_in_time(Condition condition) noexcept {
  const auto latest = SteadyClock::now() + max_return_time;
  while (!condition() && SteadyClock::now() < latest) std::this_thread::sleep_for(look_for_end);
  return condition();
}

double microseconds(SteadyClock::duration duration) {
  return std::chrono::duration<double, std::micro>(duration).count();
}

LoopEnd end_of(StepStatus status) {
  switch (status) {
    case StepStatus::ok: return LoopEnd::running;
    case StepStatus::collision_failed: return LoopEnd::collision_failed;
    case StepStatus::not_finite: return LoopEnd::not_finite;
  }
  return LoopEnd::not_finite;
}

}  // namespace

std::string message_of(LoopEnd end) {
  switch (end) {
    case LoopEnd::device_fault:
      return "The haptic device stopped answering; check its cable and power, then start a new session.";
    case LoopEnd::collision_failed: return "The OpenCL device failed; start again with --backend cpu.";
    case LoopEnd::not_finite:
      return "The handle was more than 2 m from the origin, or a force was not a number; the "
             "force was set to zero and the session ended.";
    case LoopEnd::stood_still:
      return "The haptic loop stood still and the force was taken away; start a new session, on a computer "
             "with less to do.";
    case LoopEnd::followers_late:
      return "The recording could not keep up with the loop; check the disk, then start a new session.";
    case LoopEnd::running:
    case LoopEnd::finished:
    case LoopEnd::stopped: return "";
  }
  return "";
}

std::string failover_message(int64_t tick) {
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
      force_expires_ms_(device.traits().force_expires_ms),
      watchdog_(device.traits().stale) {
  if (options.wall_clock)
    guard_.emplace(device, LoopGuard::limit_for(device.traits()), options.realtime != Realtime::off,
                   options.guard_now_ns);
}

HapticLoop::~HapticLoop() {
  stop();
  if (!thread_.joinable()) return;
  if (!comes_true_in_time([this] { return ended(); }))
    device::end_process_without_force(
        "a haptic loop stands still in its device, which does not come back; check "
        "the device's cable and power");
  thread_.join();
}

void HapticLoop::start() {
  const bool realtime = options_.wall_clock && options_.realtime != Realtime::off;
  device_.use_priority(realtime ? driver_fifo_priority : 0);
  device_.open();
  std::atomic<bool> asked{false};
  bool usable = true;
  try {
    thread_ = start_thread([this, &asked, &usable] {
      if (options_.wall_clock) health_.realtime = ask_for_realtime(options_.realtime, options_.cpu);
      usable = options_.realtime != Realtime::require || refusal().empty();
      const bool runs = usable;
      asked.store(true, std::memory_order_release);
      asked.notify_one();
      if (runs) loop();
    });
  } catch (const std::system_error& e) {
    device_.close();
    throw Error(ErrorKind::unavailable,
                std::string("no thread can be started for the haptic loop: ") + e.what());
  }
  asked.wait(false, std::memory_order_acquire);
  if (usable) return;
  thread_.join();
  device_.close();
  throw Error(ErrorKind::unavailable, refusal());
}

std::string HapticLoop::refusal() const {
  if (!options_.wall_clock) return "";
  return refusal_message(health_.realtime, options_.realtime, options_.cpu);
}

LoopEnd HapticLoop::run() {
  device_.open();
  loop();
  return health().end;
}

void HapticLoop::stop() noexcept {
  request_stop();
  if (!thread_.joinable()) return;
  comes_true_in_time([this] { return ended() || stood_still_ms() > 0; });
  if (ended()) thread_.join();
}

LoopHealth HapticLoop::health() noexcept {
  published_.take(last_seen_);
  return last_seen_;
}

void HapticLoop::loop() noexcept {
  LoopEnd end = LoopEnd::running;
  {
    const device::DeviceGuard guard(device_);
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
      summarise(state_.tick % publish_every_ticks);
    }
    if (guard_) guard_->closing(std::chrono::milliseconds(static_cast<int64_t>(device_.closing_ms())));
  }
  for (uint32_t which = 0; which < summaries; ++which) summarise(which);
  if (guard_) guard_->end();
  publish(end);
  ended_.store(true, std::memory_order_release);
}

LoopEnd HapticLoop::one_tick(device::DeviceInput& input, double lateness_us) noexcept {
  TickTiming timing;
  timing.lateness_us = lateness_us;
  const bool held = paused_.load(std::memory_order_relaxed);
  const auto start = SteadyClock::now();
  device_.session_paused(held);
  const device::DeviceStatus read = device_.read(input);
  timing.read_us = elapsed_us(start);
  if (read == device::DeviceStatus::finished) return LoopEnd::finished;
  if (read != device::DeviceStatus::ok) return LoopEnd::device_fault;
  return compute_and_write(input, held, timing);
}

/// Whether the device has let go by itself, as it has been told nothing for too long.
bool HapticLoop::force_expired() const noexcept {
  const double silent_ms = static_cast<double>(steady_ns() - written_ns_) * 1e-6;
  return options_.wall_clock && written_ns_ > 0 && silent_ms > force_expires_ms_;
}

LoopEnd HapticLoop::compute_and_write(const device::DeviceInput& input, bool held,
                                      TickTiming& timing) noexcept {
  device::DeviceInput trusted = input;
  const device::LinkState link = watchdog_.judge(state_.tick, trusted);
  // From nothing, the force may only rise as it does at the start.
  trusted.paused |= held || let_go_ || force_expired();
  TickReport report;
  const auto start = SteadyClock::now();
  const StepStatus status = step(model_, state_, trusted, report);
  report.link = link;
  report.held = held;
  const auto stepped = SteadyClock::now();
  timing.step_us = microseconds(stepped - start);
  device::DeviceStatus written = device::DeviceStatus::ok;
  device::DeviceOutput output = output_of(report);
  let_go_ = force_expired() && !report.paused;
  if (let_go_) output.force_n = output.torque_n_mm = output.vibration_n = Vec3::Zero();
  if (status == StepStatus::ok) written = device_.write(output);
  written_ns_ = steady_ns();
  timing.write_us = elapsed_us(stepped);
  report.timing = timing;
  black_box_.remember(report);
  if (status != StepStatus::ok) return end_of(status);

  count(timing);
  // Bone may have been cut, so the tick is reported even when it is the last.
  const bool pushed = push(report);
  if (written != device::DeviceStatus::ok) return LoopEnd::device_fault;
  return pushed ? LoopEnd::running : LoopEnd::followers_late;
}

void HapticLoop::count(const TickTiming& timing) noexcept {
  tick_us_.add(timing.read_us + timing.step_us + timing.write_us);
  lateness_us_.add(timing.lateness_us);
  read_us_.add(timing.read_us);
  step_us_.add(timing.step_us);
  write_us_.add(timing.write_us);
  if (timing.lateness_us >= 1000.0) ++health_.missed;
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

/// Looking through a histogram takes a few us, so each has a tick of its own.
void HapticLoop::summarise(uint32_t which) noexcept {
  switch (which) {
    case 0: health_.tick_us = tick_us_.summary(); break;
    case 1: health_.lateness_us = lateness_us_.summary(); break;
    case 2: health_.read_us = read_us_.summary(); break;
    case 3: health_.step_us = step_us_.summary(); break;
    case 4: health_.write_us = write_us_.summary(); break;
    case summaries: publish(LoopEnd::running); break;
    default: break;
  }
}

void HapticLoop::publish(LoopEnd end) noexcept {
  health_.end = end;
  health_.tick = state_.tick;
  health_.failed_over_tick = state_.failed_over_tick;
  health_.link = watchdog_.state();
  health_.losses = watchdog_.losses();
  health_.lost_tick = watchdog_.lost_tick();
  published_.store(health_);
}

}  // namespace ream::sim
