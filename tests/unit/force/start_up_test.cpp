#include "force/hand_safety.hpp"

#include <gtest/gtest.h>

namespace ream::force {
namespace {

TEST(StartUpRamp, RendersAllAtOnceWithoutARamp) {
  StartUpRamp ramp(0.0);
  EXPECT_EQ(ramp.next(50.0), 1.0);
}

TEST(StartUpRamp, WaitsForASmallForceThenRisesEvenly) {
  StartUpRamp ramp(2.0);
  for (int i = 0; i < 500; ++i) ASSERT_EQ(ramp.next(5.0), 0.0);
  // A single small value may be chance.
  EXPECT_EQ(ramp.next(0.1), 0.0);
  EXPECT_EQ(ramp.next(5.0), 0.0);
  for (int i = 0; i < StartUpRamp::small_ticks; ++i) ASSERT_EQ(ramp.next(0.1), 0.0);
  double previous = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double gain = ramp.next(5.0);
    ASSERT_NEAR(gain, i / 2000.0, 1e-9);
    ASSERT_GE(gain, previous);
    previous = gain;
  }
  EXPECT_EQ(ramp.next(5.0), 1.0);
}

TEST(StartUpRamp, MeetsAHandThatNeverEasesTooByTheSameRamp) {
  StartUpRamp ramp(1.0);
  for (int i = 0; i < StartUpRamp::max_wait_ticks; ++i) ASSERT_EQ(ramp.next(5.0), 0.0);
  for (int i = 1; i <= 1000; ++i) ASSERT_NEAR(ramp.next(5.0), i / 1000.0, 1e-9);
}

TEST(StartUpRamp, BeginsAgainAfterAnInterruption) {
  StartUpRamp ramp(1.0);
  for (int i = 0; i < 2000; ++i) ramp.next(0.0);
  ASSERT_EQ(ramp.next(5.0), 1.0);
  ramp.restart();
  EXPECT_EQ(ramp.next(5.0), 0.0);
}

}  // namespace
}  // namespace ream::force
