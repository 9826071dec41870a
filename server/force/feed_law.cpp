#include "force/feed_law.hpp"

#include <algorithm>

namespace ream::force {

double empirical_feed_mm_s(int bone_class, double density_g_cc, double specimen_factor) noexcept {
  const FeedLaw& law = bone_class == 1 ? cortical_feed_law : cancellous_feed_law;
  const double feed_mm_s =
      bone_class == 2 ? cartilage_feed_mm_s : law.slope_mm_s_per_g_cc * density_g_cc + law.intercept_mm_s;
  return std::max(slowest_feed_mm_s, specimen_factor * feed_mm_s);
}

double lawful_resistance_n_s_mm(const EngagedBone& bone, const FeedSettings& settings) noexcept {
  double resistance = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<size_t>(k);
    if (bone.share[i] > 0.0)
      resistance += bone.share[i] * reference_thrust_n /
                    empirical_feed_mm_s(k, bone.density_g_cc[i], settings.specimen_factor);
  }
  return resistance * (reference_spindle_rad_s / settings.spindle_rad_s);
}

double feed_a_revolution_mm(double feed_mm_s, double spindle_rad_s) noexcept {
  return feed_mm_s * (2.0 * pi) / spindle_rad_s;
}

}  // namespace ream::force
