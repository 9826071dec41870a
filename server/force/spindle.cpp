#include "force/spindle.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock.hpp"
#include "core/units.hpp"

namespace ream::force {
namespace {

/// Time in which standing lips sink in, and the angle on which they tear loose. Engineering choices.
constexpr double sinking_s = 0.05, tearing_rad = 0.2;

double towards(double from, double to, double step) noexcept {
  return from + std::clamp(to - from, -step, step);
}

}  // namespace

void Spindle::follow(double asked_rad_s, double full_rad_s) noexcept {
  const bool faster = std::abs(asked_rad_s) > std::abs(set_rad_s_) && asked_rad_s * set_rad_s_ >= 0.0;
  const double ramp_s = faster ? settings_->start_s : settings_->coast_s;
  set_rad_s_ = towards(set_rad_s_, asked_rad_s, full_rad_s / ramp_s * tick_s);
}

double Spindle::held_back_n_mm(const SpindleLoad& load) const noexcept {
  return load.torque_n_mm * (1.0 + (settings_->catch_ratio - 1.0) * bite_);
}

void Spindle::advance(double asked_rad_s, double full_rad_s, const SpindleLoad& load) noexcept {
  if (!settings_) {
    speed_rad_s_ = asked_rad_s;
    motor_n_mm_ = bone_n_mm_ = asked_rad_s == 0.0  ? 0.0
                               : asked_rad_s > 0.0 ? load.torque_n_mm
                                                   : -load.torque_n_mm;
    return;
  }
  follow(asked_rad_s, full_rad_s);
  // Implicit in the motor's own reaction to speed; bone only ever holds back.
  const double gain = rad_s2_per_n_mm_kg_mm2 * tick_s / settings_->inertia_kg_mm2;
  const double stiffness = 1.0 / settings_->droop_rad_s_per_n_mm;
  const double lost_rad_s = gain * held_back_n_mm(load);
  const double aimed_rad_s =
      towards(speed_rad_s_ + gain * stiffness * set_rad_s_, 0.0, lost_rad_s) / (1.0 + gain * stiffness);
  motor_n_mm_ = std::clamp(stiffness * (set_rad_s_ - aimed_rad_s), -settings_->stall_torque_n_mm,
                           settings_->stall_torque_n_mm);
  const double driven_rad_s = speed_rad_s_ + gain * motor_n_mm_;
  speed_rad_s_ = towards(driven_rad_s, 0.0, lost_rad_s);
  bone_n_mm_ = (driven_rad_s - speed_rad_s_) / gain;

  const bool stands = std::abs(speed_rad_s_) < standing_share * full_rad_s;
  if (stands && load.lips_bite)
    bite_ = std::min(1.0, bite_ + tick_s / sinking_s);
  else
    bite_ = load.lips_bite ? std::max(0.0, bite_ - std::abs(speed_rad_s_) * tick_s / tearing_rad) : 0.0;
  held_ticks_ = stands && load.lips_bite && asked_rad_s != 0.0 ? held_ticks_ + 1 : 0;
}

}  // namespace ream::force
