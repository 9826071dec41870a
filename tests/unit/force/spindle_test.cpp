#include "force/spindle.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ream::force {
namespace {

// As the drive is described for people: full speed 156 rpm; 6 N m; 10 % slower under 1 N m; 0.25 s to start.
constexpr double full_rad_s = 156.0 / 60.0 * 6.283185307179586;
constexpr double one_n_m = 1000.0;

Spindle run(double seconds, double asked_rad_s, const SpindleLoad& load,
            Spindle spindle = Spindle(SpindleSettings{})) {
  for (int tick = 0; tick < std::lround(1000.0 * seconds); ++tick)
    spindle.advance(asked_rad_s, full_rad_s, load);
  return spindle;
}

TEST(Spindle, WithoutADriveItHasItsSpeedAtOnce) {
  Spindle spindle{std::nullopt};
  spindle.advance(full_rad_s, full_rad_s, {50.0 * one_n_m, true});
  EXPECT_EQ(spindle.speed_rad_s(), full_rad_s);
  EXPECT_EQ(spindle.motor_torque_n_mm(), 50.0 * one_n_m);
  EXPECT_FALSE(spindle.is_stalled());
  spindle.advance(-full_rad_s, full_rad_s, {50.0 * one_n_m, true});
  EXPECT_EQ(spindle.motor_torque_n_mm(), -50.0 * one_n_m);
  spindle.advance(0.0, full_rad_s, {50.0 * one_n_m, true});
  EXPECT_EQ(spindle.speed_rad_s(), 0.0);
  EXPECT_EQ(spindle.motor_torque_n_mm(), 0.0);
}

TEST(Spindle, StartsInAQuarterOfASecondAndRunsDownSooner) {
  EXPECT_LT(run(0.2, full_rad_s, {}).speed_rad_s(), 0.85 * full_rad_s);
  const Spindle turning = run(0.35, full_rad_s, {});
  EXPECT_NEAR(turning.speed_rad_s(), full_rad_s, 1e-3 * full_rad_s);
  EXPECT_NEAR(turning.motor_torque_n_mm(), 0.0, 5.0);
  const Spindle down = run(0.2, 0.0, {}, turning);
  EXPECT_LT(std::abs(down.speed_rad_s()), 0.01 * full_rad_s);
  EXPECT_NEAR(run(1.0, -0.5 * full_rad_s, {}, down).speed_rad_s(), -0.5 * full_rad_s, 1e-3 * full_rad_s);
}

TEST(Spindle, TakesTorqueToSpinUpAsItsInertiaSays) {
  // Half way up the ramp the speed grows by full / 0.25 s each second.
  const double expected_n_mm = 3600.0 * full_rad_s / 0.25 / 1000.0;
  EXPECT_NEAR(run(0.125, full_rad_s, {}).motor_torque_n_mm(), expected_n_mm, 0.02 * expected_n_mm);
}

TEST(Spindle, TellsWhatTheBoneTookOfItsTorque) {
  Spindle spindle{SpindleSettings{}};
  for (int tick = 0; tick < 100; ++tick) spindle.advance(full_rad_s, full_rad_s, {});
  EXPECT_GT(spindle.motor_torque_n_mm(), 100.0) << "it still speeds up";
  EXPECT_NEAR(spindle.bone_torque_n_mm(), 0.0, 1e-6) << "in the air";
  for (int tick = 0; tick < 900; ++tick) spindle.advance(full_rad_s, full_rad_s, {one_n_m, false});
  EXPECT_NEAR(spindle.bone_torque_n_mm(), one_n_m, 1e-6);
}

TEST(Spindle, SagsUnderTorque) {
  const SpindleLoad load{one_n_m, true};
  const Spindle spindle = run(1.0, full_rad_s, load, run(0.5, full_rad_s, {}));
  EXPECT_NEAR(spindle.speed_rad_s(), 0.9 * full_rad_s, 1e-3 * full_rad_s);
  EXPECT_NEAR(spindle.motor_torque_n_mm(), one_n_m, 1.0);
  EXPECT_FALSE(spindle.is_stalled());
}

TEST(Spindle, StallsAtItsLimitAndTurnsAgainWhenLetGo) {
  Spindle spindle = run(0.5, full_rad_s, {});
  spindle = run(0.5, full_rad_s, {6.5 * one_n_m, true}, spindle);
  EXPECT_TRUE(spindle.is_stalled());
  EXPECT_EQ(spindle.speed_rad_s(), 0.0);
  EXPECT_EQ(spindle.motor_torque_n_mm(), 6.0 * one_n_m);
  spindle = run(0.3, full_rad_s, {}, spindle);
  EXPECT_FALSE(spindle.is_stalled());
  EXPECT_NEAR(spindle.speed_rad_s(), full_rad_s, 1e-2 * full_rad_s);
}

TEST(Spindle, LipsThatStoodInBoneCatchAndTearLoose) {
  const SpindleLoad seated{480.0, true};  // 52 N on the whole reamer
  Spindle spindle = run(0.2, 0.0, seated);
  EXPECT_FALSE(spindle.is_stalled()) << "nobody has asked it to turn";
  double peak_n_mm = 0.0;
  int stalled_at = -1, free_at = -1;
  for (int tick = 0; tick < 600; ++tick) {
    spindle.advance(full_rad_s, full_rad_s, seated);
    peak_n_mm = std::max(peak_n_mm, spindle.motor_torque_n_mm());
    if (spindle.is_stalled() && stalled_at < 0) stalled_at = tick;
    if (spindle.speed_rad_s() > 0.8 * full_rad_s && free_at < 0) free_at = tick;
  }
  EXPECT_LT(stalled_at, 50);
  EXPECT_GE(stalled_at, 0);
  EXPECT_NEAR(peak_n_mm, 6.5 * 480.0, 0.1 * 6.5 * 480.0);
  EXPECT_GT(free_at, 100) << "later than in the air";
  EXPECT_NEAR(spindle.motor_torque_n_mm(), 480.0, 5.0);
  EXPECT_FALSE(spindle.is_stalled());

  Spindle in_air = run(0.2, 0.0, {});
  for (int tick = 0; tick < 600; ++tick) {
    in_air.advance(full_rad_s, full_rad_s, {});
    EXPECT_FALSE(in_air.is_stalled()) << tick;
  }
}

TEST(Spindle, BoneNeverDrivesIt) {
  // Whatever holds it back takes energy: the motor's work is at least what the spindle has in it.
  Spindle spindle{SpindleSettings{}};
  double work_mj = 0.0;
  for (int tick = 0; tick < 4000; ++tick) {
    const double before_rad_s = spindle.speed_rad_s();
    const SpindleLoad load{tick % 700 < 350 ? 0.0 : 20.0 * (tick % 317), tick % 700 >= 350};
    spindle.advance(tick % 1500 < 900 ? full_rad_s : -0.3 * full_rad_s, full_rad_s, load);
    work_mj += spindle.motor_torque_n_mm() * 0.5 * (before_rad_s + spindle.speed_rad_s()) * 1e-3;
    const double stored_mj = 0.5 * 3600.0 * spindle.speed_rad_s() * spindle.speed_rad_s() * 1e-3;
    ASSERT_GE(work_mj, stored_mj - 1e-6 * std::abs(work_mj) - 1e-9) << tick;
  }
}

}  // namespace
}  // namespace ream::force
