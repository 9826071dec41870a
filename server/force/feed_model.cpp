#include "force/feed_model.hpp"

#include <algorithm>

#include "force/coefficients.hpp"

namespace ream::force {
namespace {

class EmpiricalFeedModel final : public FeedModel {
 public:
  CuttingLoad load(const EngagedBone& bone, double) const noexcept override {
    CuttingLoad load;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      if (bone.share[i] > 0.0)
        load.resistance_n_s_mm +=
            bone.share[i] * reference_thrust_n / empirical_feed_mm_s(k, bone.density_g_cc[i]);
    }
    return load;
  }
};

}  // namespace

double empirical_feed_mm_s(int bone_class, double density_g_cc) noexcept {
  if (bone_class == 2) return cartilage_feed_mm_s;
  const FeedLaw& law = bone_class == 1 ? cortical_feed_law : cancellous_feed_law;
  return std::max(slowest_feed_mm_s, law.slope_mm_s_per_g_cc * density_g_cc + law.intercept_mm_s);
}

std::unique_ptr<FeedModel> make_empirical_feed_model() { return std::make_unique<EmpiricalFeedModel>(); }

}  // namespace ream::force
