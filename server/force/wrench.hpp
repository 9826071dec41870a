#pragma once
#include "geometry/vec.hpp"

namespace ream::force {

/// Force and moment together. Which frame, which point and which hand (simulated or felt) is said where one
/// is given.
struct Wrench {
  Vec3 force_n = Vec3::Zero();
  Vec3 torque_n_mm = Vec3::Zero();

  Wrench scaled(double by) const { return {by * force_n, by * torque_n_mm}; }
  bool is_zero() const { return force_n.isZero(0.0) && torque_n_mm.isZero(0.0); }
};

/// What a device may be asked to render, hand side.
struct DeviceLimits {
  double force_max_n = 1e9;
  double torque_max_n_mm = 1e9;
  /// How much contact may change from one tick to the next, but for growing weaker.
  double force_slew_n = 1e9;
  double torque_slew_n_mm = 1e9;
};

/// Handle speeds that the slew limits must let pass: at half a metre a second a spring of stiffness K gains
/// K x 0.5 mm in a tick, and a wrist turns at 5 rad/s. Faster changes of contact force are steps, not bone.
/// Engineering choices: soft devices want 0.05 to 0.1 N.
inline constexpr double slew_speed_mm_s = 500.0, slew_speed_rad_s = 5.0;

/// Limits with the slew that springs of these stiffnesses need.
DeviceLimits limits_for(double force_max_n, double torque_max_n_mm, double stiffness_n_mm,
                        double angular_stiffness_n_mm_rad) noexcept;

/// Force and torque each within the device's largest, directions kept.
Wrench limited(const Wrench& wrench, const DeviceLimits& limits) noexcept;

/// The nearest to `desired` that can be reached from `previous` by weakening it as much as one likes and then
/// changing it by at most `step`: letting go is free, a jump upwards is not.
Vec3 slewed(const Vec3& previous, const Vec3& desired, double step) noexcept;
Wrench slewed(const Wrench& previous, const Wrench& desired, const DeviceLimits& limits) noexcept;

}  // namespace ream::force
