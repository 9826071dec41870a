#include "force/friction.hpp"

#include <algorithm>
#include <cmath>

namespace ream::force {

void add_friction(const Sliding& sliding, Resistance& resistance) noexcept {
  if (!(sliding.normal_force_n > 0.0)) return;
  const double spin_mm_s = sliding.turn_speed_rad_s * sliding.mean_radius_mm;
  const double speed_mm_s =
      std::max(sticking_speed_mm_s,
               std::sqrt(sliding.along_speed_mm_s * sliding.along_speed_mm_s + spin_mm_s * spin_mm_s));
  const double damping_n_s_mm = friction_coefficient * sliding.normal_force_n / speed_mm_s;
  // The point's velocity is v + w x p, its part across n is what rubs: b J^T (1 - n n^T) J.
  const Vec3& n = resistance.outward;
  const Mat3 across = damping_n_s_mm * (Mat3::Identity() - n * n.transpose());
  const Vec3& p = sliding.point_mm;
  Mat3 arm;
  arm << 0.0, p.z(), -p.y(), -p.z(), 0.0, p.x(), p.y(), -p.x(), 0.0;
  const Mat3 mixed = across * arm, turning = arm.transpose() * mixed;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) {
      resistance.cutting[static_cast<size_t>(6 * i + j)] += across(i, j);
      resistance.cutting[static_cast<size_t>(6 * i + 3 + j)] += mixed(i, j);
      resistance.cutting[static_cast<size_t>(6 * (3 + j) + i)] += mixed(i, j);
      resistance.cutting[static_cast<size_t>(6 * (3 + i) + 3 + j)] += turning(i, j);
    }
  resistance.cutting[35] += damping_n_s_mm * sliding.mean_radius_mm * sliding.mean_radius_mm;
}

}  // namespace ream::force
