#pragma once
#include "geometry/pose.hpp"

namespace ream::device {

/// How a machine may move.
struct MotionLimits {
  double speed_max_mm_s = 0.0, acceleration_max_mm_s2 = 0.0;
  double turn_rate_max_rad_s = 0.0, turn_acceleration_max_rad_s2 = 0.0;
  double reach_mm = 0.0;  ///< radius of the ball about where it began that it may not leave

  /// From the largest speed to rest.
  double stop_time_s() const { return speed_max_mm_s / acceleration_max_mm_s2; }
};

/// Set points for every tick that follow a wanted pose as closely as the limits let them: exactly where it
/// keeps to them, without overshoot where it does not. No set point is ever beyond a limit.
class MotionLimiter {
 public:
  explicit MotionLimiter(const MotionLimits& limits) : limits_(limits) {}

  /// At rest there, the middle of the reach.
  void begin(const Pose& at) noexcept;
  /// One tick towards that pose, which has itself moved since the last tick.
  const Pose& toward(const Pose& target) noexcept;
  /// One tick towards rest, as fast as the limits allow.
  const Pose& brake() noexcept;

  const Pose& now() const noexcept { return now_; }
  const Vec3& velocity_mm_s() const noexcept { return velocity_mm_s_; }
  bool at_rest() const noexcept { return velocity_mm_s_.isZero(0.0) && turn_rate_rad_s_.isZero(0.0); }

 private:
  void advance(const Vec3& velocity_mm_s, const Vec3& turn_rate_rad_s) noexcept;
  bool can_rest_after(const Vec3& velocity_mm_s) const noexcept;
  Vec3 within_reach(const Vec3& velocity_mm_s) const noexcept;

  const MotionLimits limits_;
  Vec3 center_mm_ = Vec3::Zero();
  Pose now_, target_;
  Vec3 velocity_mm_s_ = Vec3::Zero();
  Vec3 turn_rate_rad_s_ = Vec3::Zero();  ///< handle frame
};

}  // namespace ream::device
