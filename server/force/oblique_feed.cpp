#include "force/oblique_feed.hpp"

#include <algorithm>

#include "core/hash.hpp"
#include "force/feed_law.hpp"
#include "force/feed_table.hpp"

namespace ream::force {
namespace {

class ObliqueFeedModel final : public FeedModel {
 public:
  ObliqueFeedModel(const FeedSettings& settings, const Lip& lip)
      : settings_(settings),
        calibration_(make_feed_table(lip, settings.cutting, reference_spindle_rad_s)),
        table_(make_feed_table(lip, settings.cutting, settings.spindle_rad_s)) {}

  CuttingLoad load(const EngagedBone& bone, double thrust_n) const noexcept override {
    const double thrust = std::max(thrust_n, start_threshold_n);
    const double thrust_mm2 = thrust / specific_coefficient_n_mm2(bone);
    const double feed_mm = table_.feed_mm_at(thrust_mm2);
    const double feed_mm_s = feed_mm * settings_.spindle_rad_s / (2.0 * pi);
    return {thrust / feed_mm_s, table_.torque_mm3_at(feed_mm) / thrust_mm2};
  }
  uint64_t table_hash() const noexcept override { return hash_combine(calibration_.hash(), table_.hash()); }

 private:
  /// K of the bone under the reamer: 52 N at f(D) on the reference spindle.
  double specific_coefficient_n_mm2(const EngagedBone& bone) const noexcept {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      if (bone.share[i] <= 0.0) continue;
      const double feed_mm_s = empirical_feed_mm_s(k, bone.density_g_cc[i], settings_.specimen_factor);
      const double feed_mm = feed_a_revolution_mm(feed_mm_s, reference_spindle_rad_s);
      sum += bone.share[i] * reference_thrust_n / calibration_.thrust_mm2_at(feed_mm);
    }
    return sum;
  }

  FeedSettings settings_;
  FeedTable calibration_, table_;
};

}  // namespace

std::unique_ptr<FeedModel> make_oblique_feed_model(const FeedSettings& settings, const Lip& lip) {
  return std::make_unique<ObliqueFeedModel>(settings, lip);
}

}  // namespace ream::force
