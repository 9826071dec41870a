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
