#include "device/simulated/hand_model.hpp"

#include <gtest/gtest.h>

namespace ream::device {
namespace {

HandParameters still_hand() {
  HandParameters hand;
  hand.start_mm = Vec3(0, 0, -3);
  return hand;
}

Load pushed_back(double force_n) { return {Vec3(0, 0, -force_n), Vec3::Zero()}; }

TEST(HandModel, ArmSpringBalancesThePush) {
  HandParameters hand = still_hand();
  hand.arm_stiffness_n_mm = 4.0;
  HandModel model(hand, 1);
  model.begin();
  for (int tick = 0; tick < 5000; ++tick) model.advance(20.0, {});
  EXPECT_NEAR(model.plan_from_hand().translation_mm.z() - hand.start_mm.z(), 20.0 / 4.0, 1e-3);
}

TEST(HandModel, CorrectsByWhatItFeltAReactionTimeAgo) {
  HandParameters hand = still_hand();
  hand.correction_gain = 0.5;
  hand.reaction_time_s = 0.15;
  hand.mass_kg = 1.0;
  hand.arm_damping_n_s_mm = 0.0;
  HandModel model(hand, 1);
  model.begin();
  // It means 20 N and feels 12: while it has not noticed it is driven by 8 N, afterwards by 8 + 0.5 * 8.
  double before_mm_s = 0.0;
  for (int tick = 0; tick < 400; ++tick) {
    model.advance(20.0, pushed_back(12.0));
    const double gained_mm_s = model.velocity_mm_s().z() - before_mm_s;
    ASSERT_NEAR(gained_mm_s, tick < 150 ? 8.0 : 12.0, 1e-9) << "tick " << tick;
    before_mm_s = model.velocity_mm_s().z();
  }
}

TEST(HandModel, InTheAirItHasNothingToCorrect) {
  HandParameters hand = still_hand();
  HandParameters corrects = hand;
  corrects.correction_gain = 0.9;
  HandModel a(hand, 1), b(corrects, 1);
  a.begin();
  b.begin();
  for (int tick = 0; tick < 500; ++tick) {
    a.advance(10.0, {});
    b.advance(10.0, {});
  }
  EXPECT_EQ(a.plan_from_hand().translation_mm, b.plan_from_hand().translation_mm);
}

TEST(HandModel, WithoutAWristItKeepsItsOrientation) {
  HandParameters hand = still_hand();
  hand.tilt_rad = Vec3(0.1, 0.2, 0.0);
  HandModel model(hand, 1);
  model.begin();
  const Mat3 before = model.plan_from_hand().rotation;
  for (int tick = 0; tick < 100; ++tick) model.advance(1.0, {Vec3::Zero(), Vec3(1e4, 1e4, 1e4)});
  EXPECT_EQ(model.plan_from_hand().rotation, before);
}

TEST(HandModel, WristYieldsAsASpringAndComesBack) {
  HandParameters hand = still_hand();
  hand.tilt_rad = Vec3(0.3, 0.0, 0.0);
  hand.wrist = Wrist{5000.0, 200.0, 10000.0};
  HandModel model(hand, 1);
  model.begin();
  // Torque about the line it holds, which is tilted against the plan frame's z axis.
  const Vec3 line = model.held_rotation().col(2);
  for (int tick = 0; tick < 3000; ++tick) model.advance(0.0, {Vec3::Zero(), 400.0 * line});
  const Mat3 turned = model.held_rotation().transpose() * model.plan_from_hand().rotation;
  EXPECT_NEAR((small_vector_from_rotation(turned) - Vec3(0, 0, 400.0 / 5000.0)).norm(), 0.0, 1e-6);
  for (int tick = 0; tick < 3000; ++tick) model.advance(0.0, {});
  EXPECT_NEAR(model.turn_rad().norm(), 0.0, 1e-6);
}

TEST(HandModel, StiffLightWristsStayFinite) {
  for (const double stiffness : {0.0, 1.0e6})
    for (const double inertia : {100.0, 1.0e6}) {
      HandParameters hand = still_hand();
      hand.wrist = Wrist{stiffness, 0.0, inertia};
      HandModel model(hand, 1);
      model.begin();
      double largest_rad = 0.0;
      for (int tick = 0; tick < 2000; ++tick) {
        model.advance(0.0, {Vec3::Zero(), Vec3(0, 0, tick < 10 ? 1000.0 : 0.0)});
        largest_rad = std::max(largest_rad, std::abs(model.turn_rad().z()));
      }
      EXPECT_TRUE(std::isfinite(model.turn_rad().z()));
      if (stiffness > 0.0) {
        EXPECT_LT(largest_rad, 0.01) << "inertia " << inertia;
      }
    }
}

TEST(HandModel, TremorMovesTheHandByItsSeed) {
  HandParameters hand = still_hand();
  hand.tremor_rms_n = 2.0;
  const auto end_of = [&](uint64_t seed) {
    HandModel model(hand, seed);
    model.begin();
    for (int tick = 0; tick < 1000; ++tick) model.advance(0.0, {});
    return model.plan_from_hand().translation_mm;
  };
  EXPECT_NE(end_of(1), hand.start_mm);
  EXPECT_EQ(end_of(1), end_of(1));
  EXPECT_NE(end_of(1), end_of(2));
}

TEST(HandModel, BeginsAnew) {
  HandParameters hand = still_hand();
  hand.tremor_rms_n = 1.0;
  hand.correction_gain = 0.5;
  hand.wrist = Wrist{};
  HandModel model(hand, 4);
  Pose first;
  for (int run = 0; run < 2; ++run) {
    model.begin();
    for (int tick = 0; tick < 700; ++tick) model.advance(20.0, {Vec3(0, 0, -15), Vec3(100, 0, 50)});
    if (run == 0) first = model.plan_from_hand();
  }
  EXPECT_EQ(model.plan_from_hand().translation_mm, first.translation_mm);
  EXPECT_EQ(model.plan_from_hand().rotation, first.rotation);
}

}  // namespace
}  // namespace ream::device
