#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/clock.hpp"
#include "device/admittance/admittance_machine.hpp"

namespace ream::test {

/// What happens to a machine, from one of its ticks on, for so many ticks.
struct MachineFault {
  enum class Kind { none, silent, no_number, clipped, lags, collides, unreadable, deaf } kind = Kind::none;
  int64_t from = 0;
  int64_t ticks = std::numeric_limits<int64_t>::max() / 2;
};

/// A machine to which things happen, and that sees what it is told: every set point is held against its
/// limits, calls are kept in order.
class WatchedMachine final : public device::AdmittanceMachine {
 public:
  struct Seen {
    std::vector<std::string> calls;  ///< "open", "enable", "disable", ...; "rest": no motion any more
    std::vector<Pose> told;
    std::vector<Pose> measured;  ///< where it was, in every tick since its motors are on
    double fastest_mm_s = 0.0, hardest_mm_s2 = 0.0, farthest_mm = 0.0;
    int64_t last_motion = -1;  ///< set point of which tick was the last that moved
    std::atomic<int> stops{0};
    int told_after_stop = 0;  ///< set points
  };

  WatchedMachine(std::unique_ptr<device::AdmittanceMachine> machine, std::shared_ptr<Seen> seen,
                 const MachineFault& fault = {})
      : machine_(std::move(machine)), seen_(std::move(seen)), fault_(fault) {}

  const device::DeviceTraits& traits() const noexcept override { return machine_->traits(); }
  const device::MachineLimits& limits() const noexcept override { return machine_->limits(); }
  void open() override {
    machine_->open();
    seen_->calls.emplace_back("open");
    senses_ = 0;
    enabled_ = false;
  }
  void enable() override {
    machine_->enable();
    seen_->calls.emplace_back("enable");
    senses_ = -1;  // a look at where it holds comes before the first tick
    enabled_ = true;
  }

  device::DeviceStatus sense(device::MachineSense& sense) noexcept override {
    using Kind = MachineFault::Kind;
    const device::MachineSense before = last_;
    const device::DeviceStatus status = machine_->sense(sense);
    if (begun_ && seen_->told.empty()) begun_ = false;
    if (!begun_ && status == device::DeviceStatus::ok) first_ = sense.base_from_handle;
    last_ = sense;
    if (enabled_ && senses_ >= 0) seen_->measured.push_back(sense.base_from_handle);
    const bool now = enabled_ && senses_ >= fault_.from && senses_ < fault_.from + fault_.ticks;
    ++senses_;
    if (!now) return status;
    if (fault_.kind == Kind::silent) {
      sense = last_ = before;
      sense.age_ms = static_cast<double>(senses_ - fault_.from);
    }
    if (fault_.kind == Kind::no_number) sense.force_n.y() = std::nan("");
    if (fault_.kind == Kind::clipped || fault_.kind == Kind::collides)
      sense.force_n.x() = limits().sensor_range_n;
    if (fault_.kind == Kind::lags || fault_.kind == Kind::collides)
      sense.base_from_handle.translation_mm.x() += 2.0 * limits().following_error_max_mm;
    if (fault_.kind == Kind::unreadable) return device::DeviceStatus::fault;
    return status;
  }

  bool move_to(const Pose& at) noexcept override {
    const Pose before = seen_->told.empty() ? first_ : seen_->told.back();
    begun_ = true;
    if (seen_->stops > 0) ++seen_->told_after_stop;
    const Vec3 velocity_mm_s = (at.translation_mm - before.translation_mm) / tick_s;
    seen_->fastest_mm_s = std::max(seen_->fastest_mm_s, velocity_mm_s.norm());
    seen_->hardest_mm_s2 = std::max(seen_->hardest_mm_s2, (velocity_mm_s - velocity_mm_s_).norm() / tick_s);
    seen_->farthest_mm = std::max(seen_->farthest_mm, (at.translation_mm - first_.translation_mm).norm());
    if (!velocity_mm_s.isZero(1e-9)) seen_->last_motion = senses_ - 1;
    velocity_mm_s_ = velocity_mm_s;
    seen_->told.push_back(at);
    if (fault_.kind == MachineFault::Kind::deaf && senses_ > fault_.from) return false;
    return machine_->move_to(at);
  }
  void session_paused(bool paused) noexcept override { machine_->session_paused(paused); }
  void stop() noexcept override {
    ++seen_->stops;
    machine_->stop();
  }
  void disable() noexcept override {
    if (velocity_mm_s_.isZero(1e-9)) seen_->calls.emplace_back("rest");
    machine_->disable();
    seen_->calls.emplace_back("disable");
  }
  void close() noexcept override {
    machine_->close();
    seen_->calls.emplace_back("close");
  }

 private:
  const std::unique_ptr<device::AdmittanceMachine> machine_;
  const std::shared_ptr<Seen> seen_;
  const MachineFault fault_;
  device::MachineSense last_;
  Pose first_;
  Vec3 velocity_mm_s_ = Vec3::Zero();
  int64_t senses_ = 0;
  bool begun_ = false, enabled_ = false;
};

/// No set point was beyond what the machine can do.
inline void expect_within_limits(const WatchedMachine::Seen& seen, const device::MotionLimits& limits) {
  EXPECT_LE(seen.fastest_mm_s, limits.speed_max_mm_s * (1.0 + 1e-9));
  EXPECT_LE(seen.hardest_mm_s2, limits.acceleration_max_mm_s2 * (1.0 + 1e-6));
  EXPECT_LE(seen.farthest_mm, limits.reach_mm);
}

}  // namespace ream::test
