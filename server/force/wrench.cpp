#include "force/wrench.hpp"

#include <algorithm>

#include "core/clock.hpp"

namespace ream::force {

DeviceLimits limits_for(double force_max_n, double torque_max_n_mm, double stiffness_n_mm,
                        double angular_stiffness_n_mm_rad) noexcept {
  return {force_max_n, torque_max_n_mm, stiffness_n_mm * slew_speed_mm_s * tick_s,
          angular_stiffness_n_mm_rad * slew_speed_rad_s * tick_s};
}

Wrench limited(const Wrench& wrench, const DeviceLimits& limits) noexcept {
  return {clamp_length(wrench.force_n, limits.force_max_n),
          clamp_length(wrench.torque_n_mm, limits.torque_max_n_mm)};
}

Vec3 slewed(const Vec3& previous, const Vec3& desired, double step) noexcept {
  const double squared = previous.squaredNorm();
  const double kept = squared > 0.0 ? std::clamp(previous.dot(desired) / squared, 0.0, 1.0) : 0.0;
  const Vec3 weakened = kept * previous;
  return weakened + clamp_length(desired - weakened, step);
}

Wrench slewed(const Wrench& previous, const Wrench& desired, const DeviceLimits& limits) noexcept {
  return {slewed(previous.force_n, desired.force_n, limits.force_slew_n),
          slewed(previous.torque_n_mm, desired.torque_n_mm, limits.torque_slew_n_mm)};
}

}  // namespace ream::force
