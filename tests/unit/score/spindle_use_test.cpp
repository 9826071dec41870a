#include "score/spindle_use.hpp"

#include <gtest/gtest.h>

#include "core/units.hpp"

namespace ream::score {
namespace {

using record::TickReport;

TickReport tick(bool engaged, bool spindle_on, double thrust_n = 0.0) {
  TickReport r;
  r.engaged = engaged;
  r.spindle_on = spindle_on;
  r.thrust_n = thrust_n;
  return r;
}

TEST(SpindleUse, CountsWhatIsTaughtOtherwise) {
  SpindleUse use;
  const auto go = [&](int ticks, const TickReport& report) {
    for (int i = 0; i < ticks; ++i) use.add(report);
  };
  go(100, tick(false, false));      // on the way, which is no idle time
  go(20, tick(true, false, 6.0));   // pressed on with a standing reamer
  go(30, tick(true, false, 4.9));   // resting on the bone
  go(40, tick(false, true));        // turning in the air, between contacts
  go(500, tick(true, true, 50.0));  // reaming
  go(60, tick(false, false));       // stopped, between contacts
  go(10, tick(false, true));        // started again
  TickReport paused = tick(false, false);
  paused.paused = true;
  go(1000, paused);
  go(50, tick(true, true, 50.0));
  go(70, tick(false, false));  // withdrawn, which is no idle time
  MetricResults results;
  use.write(results);
  EXPECT_DOUBLE_EQ(*results.value("standing_press_time_s"), 0.020);
  EXPECT_DOUBLE_EQ(*results.value("air_spin_time_s"), 0.050);
  EXPECT_DOUBLE_EQ(*results.value("idle_time_s"), 0.110);
  EXPECT_EQ(*results.value("spindle_restarts"), 1.0);
}

class StartsOnBone : public testing::Test {
 protected:
  void go(int ticks, const TickReport& report) {
    for (int i = 0; i < ticks; ++i) use_.add(report);
  }
  void expect(double starts, double before_spin_s, double withdrawn_spin_s) {
    MetricResults results;
    use_.write(results);
    EXPECT_EQ(*results.value("spindle_starts_in_contact"), starts);
    EXPECT_DOUBLE_EQ(*results.value("contact_before_spin_s"), before_spin_s);
    EXPECT_DOUBLE_EQ(*results.value("withdrawn_spin_time_s"), withdrawn_spin_s);
  }

  SpindleUse use_;
};

TEST_F(StartsOnBone, AsIsTaughtThereAreNone) {
  go(100, tick(false, false));
  go(50, tick(false, true));  // started in the air
  go(500, tick(true, true, 50.0));
  go(30, tick(false, true));  // withdrawn
  go(20, tick(false, false));
  expect(0, 0.0, 0.030);
}

TEST_F(StartsOnBone, TouchingFirstCountsWithItsTime) {
  go(80, tick(true, false, 0.5));  // touched lightly, which is no press
  go(3, tick(false, false));       // it bounces
  go(40, tick(true, false, 9.0));
  go(500, tick(true, true, 50.0));
  expect(1, 0.120, 0.0);
  go(60, tick(true, false, 50.0));  // stopped in the bone, and started there again
  go(500, tick(true, true, 50.0));
  expect(2, 0.180, 0.0);
}

TEST_F(StartsOnBone, AProbeThatIsTakenAwayIsNone) {
  go(80, tick(true, false, 9.0));
  go(100, tick(false, false));
  go(50, tick(false, true));
  go(500, tick(true, true, 50.0));
  expect(0, 0.0, 0.050);
  go(70, tick(true, false, 50.0));  // stopped while in contact, and withdrawn
  go(600, tick(false, false));
  go(10, tick(true, false, 1.0));
  go(10, tick(true, true, 1.0));
  expect(1, 0.010, 0.050);
}

TEST_F(StartsOnBone, APauseAddsNothing) {
  go(10, tick(true, false, 9.0));
  TickReport paused = tick(true, true, 9.0);
  paused.paused = true;
  go(1000, paused);
  go(10, tick(true, false, 9.0));
  go(10, tick(true, true, 9.0));
  expect(1, 0.020, 0.0);
}

TEST(AxisSteadiness, IsTheSpreadOfTheAxisWhileItCuts) {
  AxisSteadiness steadiness;
  MetricResults results;
  steadiness.write(results);
  EXPECT_FALSE(results.value("axis_sd_deg"));
  TickReport cut = tick(true, true, 20.0);
  cut.cutting = true;
  for (int i = 0; i < 1000; ++i) {
    const double lean = radians_from_degrees(i % 2 == 0 ? 2.0 : -2.0);
    steadiness.add(cut, {rotation_from_small_vector(Vec3(lean, 0.0, 0.0)), Vec3::Zero()});
    // Off the bone it may point anywhere.
    steadiness.add(tick(false, true), {rotation_from_small_vector(Vec3(0.0, 1.0, 0.0)), Vec3::Zero()});
  }
  steadiness.write(results);
  EXPECT_NEAR(*results.value("axis_sd_deg"), 2.0, 1e-3);
}

}  // namespace
}  // namespace ream::score
