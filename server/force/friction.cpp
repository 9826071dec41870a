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
  const Vec3& n = resistance.outward;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      resistance.cutting[static_cast<size_t>(6 * i + j)] +=
          damping_n_s_mm * ((i == j ? 1.0 : 0.0) - n[i] * n[j]);
  resistance.cutting[35] += damping_n_s_mm * sliding.mean_radius_mm * sliding.mean_radius_mm;
}

}  // namespace ream::force
