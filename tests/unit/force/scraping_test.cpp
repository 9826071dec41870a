#include "force/feed_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ream::force {
namespace {

std::unique_ptr<FeedModel> make_scraping(FeedSettings settings, double seated_area_mm2) {
  settings.kind = FeedKind::scraping;
  return make_feed_model(settings, {{}, seated_area_mm2});
}

EngagedBone cortical_bone(double area_mm2) {
  EngagedBone bone;
  bone.share = {0, 1, 0};
  bone.density_g_cc = {0, 1.5, 0};
  bone.area_mm2 = area_mm2;
  return bone;
}

TEST(Scraping, ResistanceGrowsWithTheRootOfTheArea) {
  const auto model = make_scraping({}, 100.0);
  const double seated = model->load(cortical_bone(100.0), 52.0).resistance_n_s_mm;
  EXPECT_NEAR(seated, 52.0 / 0.035, 1e-9);
  EXPECT_NEAR(model->load(cortical_bone(400.0), 52.0).resistance_n_s_mm, 2.0 * seated, 1e-9);
  EXPECT_NEAR(model->load(cortical_bone(25.0), 52.0).resistance_n_s_mm, 0.5 * seated, 1e-9);
  EXPECT_EQ(model->load(cortical_bone(0.0), 52.0).resistance_n_s_mm, 0.0);
}

TEST(Scraping, IsTheIntegralOfWearOverTheFootprint) {
  // Even sinking at f: pressure f / (2 pi k n r) on rings of the footprint; k cancels from torque over thrust
  // and from the growth of thrust with the radius.
  FeedSettings settings;
  settings.cutting.friction = 0.4;
  const auto integral = [](double radius_mm) {
    struct {
      double thrust = 0.0, torque = 0.0;
    } sum;
    constexpr int rings = 1000;
    for (int i = 0; i < rings; ++i) {
      const double r = radius_mm * (i + 0.5) / rings, area = 2.0 * pi * r * radius_mm / rings;
      const double pressure = 1.0 / r;
      sum.thrust += pressure * area;
      sum.torque += 0.4 * pressure * r * area;
    }
    return sum;
  };
  const auto model = make_scraping(settings, pi * 36.0);
  for (const double radius_mm : {1.0, 6.0, 13.0}) {
    const CuttingLoad load = model->load(cortical_bone(pi * radius_mm * radius_mm), 52.0);
    const auto here = integral(radius_mm), seated = integral(6.0);
    EXPECT_NEAR(load.torque_arm_mm, here.torque / here.thrust, 1e-9);
    EXPECT_NEAR(load.resistance_n_s_mm * 0.035 / 52.0, here.thrust / seated.thrust, 1e-9);
  }
}

}  // namespace
}  // namespace ream::force
