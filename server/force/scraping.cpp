#include "force/scraping.hpp"

#include <cmath>

#include "force/feed_law.hpp"

namespace ream::force {
namespace {

class ScrapingFeedModel final : public FeedModel {
 public:
  ScrapingFeedModel(const FeedSettings& settings, double seated_area_mm2)
      : settings_(settings), seated_radius_mm_(std::sqrt(seated_area_mm2 / pi)) {}

  CuttingLoad load(const EngagedBone& bone, double) const noexcept override {
    const double radius_mm = std::sqrt(bone.area_mm2 / pi);
    return {lawful_resistance_n_s_mm(bone, settings_) * radius_mm / seated_radius_mm_,
            0.5 * settings_.cutting.friction * radius_mm};
  }

 private:
  FeedSettings settings_;
  double seated_radius_mm_;
};

}  // namespace

std::unique_ptr<FeedModel> make_scraping_feed_model(const FeedSettings& settings, double seated_area_mm2) {
  return std::make_unique<ScrapingFeedModel>(settings, seated_area_mm2);
}

}  // namespace ream::force
