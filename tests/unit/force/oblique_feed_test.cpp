#include "force/feed_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/force/thesis_lip.hpp"

namespace ream::force {
namespace {

std::unique_ptr<FeedModel> make_oblique(FeedSettings settings, const Lip& lip) {
  settings.kind = FeedKind::oblique;
  return make_feed_model(settings, lip);
}

constexpr double reference_revolutions_s = 156.0 / 60.0;

EngagedBone cancellous(double density_g_cc) {
  EngagedBone bone;
  bone.share = {1, 0, 0};
  bone.density_g_cc = {density_g_cc, 0, 0};
  return bone;
}

TEST(ObliqueFeed, TheLipsTakeTheThrustThatTheModelSays) {
  // The lip itself, with the specific coefficient that gives 52 N at f(D), fed as the model says.
  const Lip lip = test::thesis_lip(300);
  for (const double depth_exponent : {0.0, -0.3}) {
    FeedSettings settings;
    settings.cutting.depth_exponent = depth_exponent;
    settings.spindle_rad_s = 2.0 * reference_spindle_rad_s;
    settings.cutting.speed_exponent = 0.1;
    const auto model = make_oblique(settings, lip);
    const double lawful_feed_mm = (0.42 - 0.34 * 0.6) / reference_revolutions_s;
    const double coefficient = 52.0 / whole_load(lip_loads(lip, settings.cutting, {lawful_feed_mm})).thrust_n;
    for (const double thrust_n : {5.0, 20.0, 52.0, 90.0}) {
      const CuttingLoad load = model->load(cancellous(0.6), thrust_n);
      const double feed_mm = thrust_n / load.resistance_n_s_mm / (2.0 * reference_revolutions_s);
      const LipLoad lips =
          whole_load(lip_loads(lip, settings.cutting, {feed_mm, settings.spindle_rad_s, coefficient}));
      EXPECT_NEAR(lips.thrust_n, thrust_n, 1e-3 * thrust_n);
      EXPECT_NEAR(lips.torque_n_mm, thrust_n * load.torque_arm_mm, 1e-3 * lips.torque_n_mm);
    }
  }
}

TEST(ObliqueFeed, ADepthExponentBendsTheLaw) {
  // Thrust grows with feed^(1 + exponent), so that feed grows with thrust^(1 / (1 + exponent)).
  FeedSettings settings;
  settings.cutting.depth_exponent = -0.4;
  const auto model = make_oblique(settings, test::thesis_lip(300));
  const auto feed = [&](double thrust_n) {
    return thrust_n / model->load(cancellous(0.6), thrust_n).resistance_n_s_mm;
  };
  EXPECT_NEAR(std::log(feed(40.0) / feed(20.0)) / std::log(2.0), 1.0 / 0.6, 0.02);
}

TEST(ObliqueFeed, BelowTheStartThresholdResistanceStaysFinite) {
  FeedSettings settings;
  settings.cutting.depth_exponent = -0.4;
  const auto model = make_oblique(settings, test::thesis_lip(100));
  const CuttingLoad at = model->load(cancellous(0.6), start_threshold_n);
  for (const double thrust_n : {-3.0, 0.0, 0.5})
    EXPECT_EQ(model->load(cancellous(0.6), thrust_n).resistance_n_s_mm, at.resistance_n_s_mm);
  EXPECT_TRUE(std::isfinite(at.resistance_n_s_mm));
}

TEST(ObliqueFeed, TorqueIsTheLipsMeanRadiusOverFriction) {
  // Sliding edges of no inclination meet torque r for thrust friction: the arm lies between inner and outer
  // radius over friction, and falls as friction grows.
  double before = 1e9;
  for (const double friction : {0.3, 0.5, 0.8}) {
    FeedSettings settings;
    settings.cutting.friction = friction;
    const double arm =
        make_oblique(settings, test::thesis_lip(300))->load(cancellous(0.6), 52.0).torque_arm_mm;
    EXPECT_LT(arm, before);
    EXPECT_GT(arm, test::ellipse_a_mm * 2.0 / 3.0 * 0.9);
    before = arm;
  }
}

}  // namespace
}  // namespace ream::force
