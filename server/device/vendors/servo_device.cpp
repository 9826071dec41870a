#include "device/vendors/servo_device.hpp"

#include <poll.h>
#include <pthread.h>
#include <sched.h>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/signal_handlers.hpp"

namespace ream::device {
namespace {

constexpr double ms_per_ns = 1.0e-6;
constexpr int retry_ms = 500, poll_ms = 5;
constexpr int64_t max_release_ns = 10'000'000;
/// A driver that hears nothing new turns all the same, with the force as it is.
constexpr int64_t max_wait_ns = 2'000'000;

}  // namespace

ServoDevice::ServoDevice(DeviceTraits traits, std::unique_ptr<Servo> servo, int64_t (*now_ns)())
    : traits_(std::move(traits)),
      end_(link_, now_ns),
      servo_end_(link_, traits_.force_max_n, traits_.torque_max_n_mm, now_ns),
      servo_(std::move(servo)) {
  traits_.force_expires_ms = static_cast<double>(output_too_old_ns) * ms_per_ns;
}

ServoDevice::~ServoDevice() { close(); }

void ServoDevice::open() {
  close();
  end_.open();
  leaving_ = unusable_ = without_force_ = false;
  opened_ = 0;
  thread_ = start_thread([this] { run(); });
  opened_.wait(0);
  if (opened_ > 0) return;
  thread_.join();
  throw Error(ErrorKind::unavailable, refusal_);
}

void ServoDevice::close() noexcept {
  end_.write({});
  leaving_ = true;
  if (thread_.joinable()) thread_.join();
}

DeviceStatus ServoDevice::read(DeviceInput& input) noexcept {
  RemoteInput news;
  if (end_.take(news)) {
    input.world_from_handle = {rotation_from_quaternion(news.rotation_wxyz),
                               Vec3(news.place_mm[0], news.place_mm[1], news.place_mm[2])};
    input.spindle_on = news.spindle_on;
    input.paused = news.paused;
    input.clutch = news.clutch;
    input.deadman = news.deadman;
  }
  input.age_ms = end_.age_ms();
  return unusable_.load(std::memory_order_relaxed) ? DeviceStatus::fault : DeviceStatus::ok;
}

DeviceStatus ServoDevice::write(const DeviceOutput& output) noexcept {
  end_.write(output);
  return unusable_.load(std::memory_order_relaxed) ? DeviceStatus::fault : DeviceStatus::ok;
}

void ServoDevice::take_force_away() noexcept {
  without_force_.store(false);
  end_.take_force_away();
  for (const int64_t until_ns = end_.now_ns() + max_release_ns; end_.now_ns() < until_ns;) {
    if (!serving_.load() || without_force_.load()) return;
    ::poll(nullptr, 0, 1);
  }
}

/// For this thread alone: not for those that a maker's library starts on it.
void ServoDevice::apply_priority() const noexcept {
  if (fifo_priority_ == 0) return;
  sched_param parameters{};
  parameters.sched_priority = fifo_priority_;
  ::pthread_setschedparam(::pthread_self(), SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters);
}

void ServoDevice::run() {
  apply_priority();
  try {
    servo_end_.begin();
    servo_->open(servo_end_);
  } catch (const std::exception& e) {
    servo_->close();
    refusal_ = e.what();
    opened_ = -1;
    opened_.notify_one();
    return;
  }
  opened_ = 1;
  opened_.notify_one();
  while (!leaving_ && !unusable_) try {
      serve();
    } catch (const Error& e) {
      disconnect();
      unusable_ = e.kind() != ErrorKind::unavailable;
      log::warn(traits_.name + ": " + e.what() + (unusable_ ? "" : "; it is looked for again"));
      while (!unusable_ && wait_before_retry()) try {
          servo_end_.begin();
          servo_->open(servo_end_);
          log::info(traits_.name + ": it is there again");
          break;
        } catch (const std::exception&) {  // nor may want of memory or of handles end the process
          servo_->close();
        }
    } catch (const std::exception& e) {
      log::error(traits_.name + ": " + e.what());
      unusable_ = true;
    }
  disconnect();
}

void ServoDevice::serve() {
  serving_ = true;
  while (!leaving_) {
    if (!servo_->takes_force_elsewhere()) servo_end_.await_force(max_wait_ns);
    const bool away = link_->force_taken_away.load();
    servo_->turn(servo_end_);
    if (away) without_force_.store(true);
  }
}

void ServoDevice::disconnect() noexcept {
  serving_ = false;
  servo_->close();
}

/// False when the owner leaves meanwhile.
bool ServoDevice::wait_before_retry() noexcept {
  for (int waited_ms = 0; waited_ms < retry_ms; waited_ms += poll_ms) {
    if (leaving_) return false;
    ::poll(nullptr, 0, poll_ms);
  }
  return !leaving_;
}

}  // namespace ream::device
