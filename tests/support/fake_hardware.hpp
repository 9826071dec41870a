#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "support/fake_hand.hpp"

namespace ream::test {

inline int64_t monotonic_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

enum class HardwareFault : int {
  none,
  absent,      ///< the device is not there (any more)
  silent,      ///< it does not answer
  not_finite,  ///< its poses are no numbers
  absurd,      ///< they are a kilometre away
  slow,        ///< every answer takes 15 ms
  malformed,   ///< it answers what makes no sense
  force_off,   ///< its force was switched off at the device, until it is switched on again (libdhd only)
};

/// What a fake device does and what was done to it: a hand, faults on demand, and a diary of every force with
/// its time and of every call. Any thread. With FAKE_HARDWARE_LOG in the environment the diary also goes to
/// that file, line by line, so that it outlives its process; FAKE_HARDWARE_PUSH is what its hand pushes with,
/// as "N,X,Y,Z", N being newtons and X,Y,Z the direction.
class FakeHardware {
 public:
  /// A force acts until another takes its place, or for so long.
  explicit FakeHardware(double force_lives_ms = std::numeric_limits<double>::infinity())
      : force_lives_ns_(force_lives_ms * 1e6) {
    if (const char* path = std::getenv("FAKE_HARDWARE_LOG"))
      log_ = ::open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    double push = 0.0;
    const char* pushed = std::getenv("FAKE_HARDWARE_PUSH");
    if (pushed != nullptr &&
        std::sscanf(pushed, "%lf,%lf,%lf,%lf", &push, &hand_.axis[0], &hand_.axis[1], &hand_.axis[2]) == 4)
      push_n = push;
  }

  struct Sample {
    int64_t t_ns;
    double force_n, torque_n_mm;
  };

  std::atomic<double> push_n{0.0};
  std::atomic<HardwareFault> fault{HardwareFault::none};
  std::atomic<unsigned> buttons{1};

  void set_hand(const FakeHand& hand) {
    const std::lock_guard lock(mutex_);
    hand_ = hand;
  }
  /// The hand moves on for `time_s` under the force that acts now.
  std::array<double, 3> move_hand(double time_s) {
    const std::lock_guard lock(mutex_);
    hand_.advance(time_s, push_n, acting(monotonic_ns()) ? force_n_ : std::array<double, 3>{});
    return hand_.place_mm;
  }
  void render(const std::array<double, 3>& force_n, const std::array<double, 3>& torque_n_mm = {}) {
    const std::lock_guard lock(mutex_);
    force_n_ = force_n;
    const Sample sample{monotonic_ns(), std::hypot(force_n[0], force_n[1], force_n[2]),
                        std::hypot(torque_n_mm[0], torque_n_mm[1], torque_n_mm[2])};
    samples_.push_back(sample);
    char line[96];
    std::snprintf(line, sizeof line, "%lld force %.6f", static_cast<long long>(sample.t_ns), sample.force_n);
    write_line(line);
  }
  /// The device has let go by itself: its motors are off.
  void off() { render({0, 0, 0}); }
  void called(const std::string& name) {
    const std::lock_guard lock(mutex_);
    calls_.push_back(name);
    write_line(std::to_string(monotonic_ns()) + " call " + name);
  }
  void refused(const std::string& why) {
    const std::lock_guard lock(mutex_);
    refusals_.push_back(why);
  }

  std::vector<Sample> samples() const {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  std::vector<std::string> calls() const {
    const std::lock_guard lock(mutex_);
    return calls_;
  }
  std::vector<std::string> refusals() const {
    const std::lock_guard lock(mutex_);
    return refusals_;
  }
  double force_now_n() const {
    const std::lock_guard lock(mutex_);
    return acting(monotonic_ns()) ? samples_.back().force_n : 0.0;
  }
  double largest_force_n() const {
    double largest = 0.0;
    for (const Sample& sample : samples()) largest = std::max(largest, sample.force_n);
    return largest;
  }
  /// From `since_ns` until no force acted for the first time, ms; infinite: it has never been so.
  double ms_until_no_force(int64_t since_ns) const {
    const std::vector<Sample> all = samples();
    double end_ns = std::numeric_limits<double>::infinity();
    for (size_t i = all.size(); i-- > 0;) {
      const auto t_ns = static_cast<double>(all[i].t_ns);
      const double next_ns =
          i + 1 < all.size() ? static_cast<double>(all[i + 1].t_ns) : std::numeric_limits<double>::infinity();
      const bool zero = all[i].force_n == 0.0;
      const double zero_from_ns = zero ? t_ns : t_ns + force_lives_ns_;
      if (next_ns <= static_cast<double>(since_ns)) break;
      if (zero_from_ns < next_ns) end_ns = std::max(zero_from_ns, static_cast<double>(since_ns));
    }
    return (end_ns - static_cast<double>(since_ns)) * 1e-6;
  }
  /// As a new device.
  void forget() {
    const std::lock_guard lock(mutex_);
    samples_.clear();
    calls_.clear();
    refusals_.clear();
    force_n_ = {};
    hand_ = {};
    push_n = 0.0;
    fault = HardwareFault::none;
    buttons = 1;
  }

 private:
  bool acting(int64_t now_ns) const {
    return !samples_.empty() && static_cast<double>(now_ns - samples_.back().t_ns) <= force_lives_ns_;
  }
  void write_line(std::string line) const {
    if (log_ < 0) return;
    line += '\n';
    [[maybe_unused]] const auto written = ::write(log_, line.data(), line.size());
  }

  const double force_lives_ns_;
  int log_ = -1;
  mutable std::mutex mutex_;
  FakeHand hand_;
  std::array<double, 3> force_n_{};
  std::vector<Sample> samples_;
  std::vector<std::string> calls_, refusals_;
};

}  // namespace ream::test
