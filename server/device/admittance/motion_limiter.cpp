#include "device/admittance/motion_limiter.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock.hpp"

namespace ream::device {
namespace {

/// Approaches are planned with this share of the acceleration, so that what is left makes up for whole ticks.
constexpr double planned_share = 0.7;

/// Closes a gap without overshoot: no faster than it can still be braked away.
Vec3 closing(const Vec3& gap, double acceleration_max) noexcept {
  return clamp_length(gap / tick_s, std::sqrt(2.0 * planned_share * acceleration_max * gap.norm()));
}

}  // namespace

void MotionLimiter::begin(const Pose& at) noexcept {
  now_ = target_ = at;
  center_mm_ = at.translation_mm;
  velocity_mm_s_.setZero();
  turn_rate_rad_s_.setZero();
}

const Pose& MotionLimiter::toward(const Pose& target) noexcept {
  const Vec3 gap_mm = target_.translation_mm - now_.translation_mm;
  const Vec3 its_velocity_mm_s = (target.translation_mm - target_.translation_mm) / tick_s;
  const Vec3 gap_rad = turn_between(now_.rotation, target_.rotation);
  const Vec3 its_turn_rate_rad_s = turn_between(target_.rotation, target.rotation) / tick_s;
  target_ = target;
  advance(its_velocity_mm_s + closing(gap_mm, limits_.acceleration_max_mm_s2),
          its_turn_rate_rad_s + closing(gap_rad, limits_.turn_acceleration_max_rad_s2));
  return now_;
}

const Pose& MotionLimiter::brake() noexcept {
  advance(Vec3::Zero(), Vec3::Zero());
  target_ = now_;
  return now_;
}

/// The outward part of a velocity, no faster than it can be braked away before the end of the reach.
Vec3 MotionLimiter::within_reach(const Vec3& velocity_mm_s) const noexcept {
  const Vec3 from_middle_mm = now_.translation_mm - center_mm_;
  const double distance_mm = from_middle_mm.norm();
  if (distance_mm <= 0.0) return velocity_mm_s;
  const Vec3 outward = from_middle_mm / distance_mm;
  const double out_mm_s = velocity_mm_s.dot(outward);
  const double left_mm = std::max(0.0, limits_.reach_mm - distance_mm - std::max(0.0, out_mm_s) * tick_s);
  const double allowed_mm_s = std::sqrt(2.0 * planned_share * limits_.acceleration_max_mm_s2 * left_mm);
  return out_mm_s > allowed_mm_s ? Vec3(velocity_mm_s - (out_mm_s - allowed_mm_s) * outward) : velocity_mm_s;
}

/// Whether it can still come to rest within the reach after a tick with that velocity. As long as it brakes
/// where the answer is no, it never leaves: the way to rest is the one that was found to end inside before.
bool MotionLimiter::can_rest_after(const Vec3& velocity_mm_s) const noexcept {
  const double speed_mm_s = velocity_mm_s.norm();
  const double ticks_to_rest = std::ceil(speed_mm_s / (limits_.acceleration_max_mm_s2 * tick_s)) + 1.0;
  const Vec3 rest_mm = now_.translation_mm + (0.5 * (ticks_to_rest + 1.0) * tick_s) * velocity_mm_s;
  return (rest_mm - center_mm_).norm() <= limits_.reach_mm;
}

void MotionLimiter::advance(const Vec3& velocity_mm_s, const Vec3& turn_rate_rad_s) noexcept {
  const double step_mm_s = limits_.acceleration_max_mm_s2 * tick_s;
  const Vec3 wanted_mm_s = within_reach(clamp_length(velocity_mm_s, limits_.speed_max_mm_s));
  const Vec3 next_mm_s = velocity_mm_s_ + clamp_length(wanted_mm_s - velocity_mm_s_, step_mm_s);
  velocity_mm_s_ =
      can_rest_after(next_mm_s) ? next_mm_s : Vec3(velocity_mm_s_ - clamp_length(velocity_mm_s_, step_mm_s));
  const Vec3 rate = clamp_length(turn_rate_rad_s, limits_.turn_rate_max_rad_s);
  turn_rate_rad_s_ += clamp_length(rate - turn_rate_rad_s_, limits_.turn_acceleration_max_rad_s2 * tick_s);
  now_.translation_mm += velocity_mm_s_ * tick_s;
  if (!turn_rate_rad_s_.isZero(0.0))
    now_.rotation = orthonormalized(now_.rotation * rotation_from_small_vector(turn_rate_rad_s_ * tick_s));
}

}  // namespace ream::device
