#include "force/wrench.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::force {
namespace {

TEST(Limits, KeepDirection) {
  const Vec3 v = clamp_length(Vec3(3, 4, 0), 2.5);
  EXPECT_NEAR(v.norm(), 2.5, 1e-12);
  EXPECT_NEAR(v.normalized().dot(Vec3(0.6, 0.8, 0)), 1.0, 1e-12);
  EXPECT_EQ(clamp_length(Vec3(1, 0, 0), 2.0), Vec3(1, 0, 0));
}

TEST(Limits, ForceAndTorqueHaveTheirOwn) {
  const DeviceLimits limits{3.3, 188.0};
  const Wrench w = limited({Vec3(0, 0, -52), Vec3(1000, 0, 0)}, limits);
  EXPECT_NEAR(w.force_n.z(), -3.3, 1e-12);
  EXPECT_NEAR(w.torque_n_mm.x(), 188.0, 1e-12);
}

TEST(SlewLimit, LetsASpringPassAtHalfAMetreASecond) {
  const DeviceLimits limits = limits_for(12.0, 0.0, 5.0, 5000.0);
  EXPECT_DOUBLE_EQ(limits.force_slew_n, 5.0 * 0.5);
  EXPECT_DOUBLE_EQ(limits.torque_slew_n_mm, 25.0);
}

TEST(SlewLimit, RisesByAStepAndFallsAtOnce) {
  EXPECT_NEAR((slewed(Vec3(0, 0, 1), Vec3(0, 0, 9), 0.5) - Vec3(0, 0, 1.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((slewed(Vec3(0, 0, 9), Vec3(0, 0, 1), 0.5) - Vec3(0, 0, 1)).norm(), 0.0, 1e-12);
  EXPECT_EQ(slewed(Vec3(0, 0, 9), Vec3::Zero(), 0.5), Vec3::Zero());
}

TEST(SlewLimit, TheOtherWayBeginsFromNothing) {
  EXPECT_NEAR((slewed(Vec3(0, 0, 9), Vec3(0, 0, -9), 0.5) - Vec3(0, 0, -0.5)).norm(), 0.0, 1e-12);
}

/// Whatever is reached lies within a step of a weakened previous force, no farther from what was wanted than
/// before, and within the largest force that both kept.
TEST(SlewLimit, ReachesTheNearestItMay) {
  const uint32_t seed = test::seed(7);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 previous = clamp_length(test::random_vector(random, 10.0), 8.0);
    const Vec3 wanted = clamp_length(test::random_vector(random, 10.0), 8.0);
    const double step = 0.7;
    const Vec3 reached = slewed(previous, wanted, step);
    double nearest = 1e9, best = 1e9;
    for (int i = 0; i <= 1000; ++i) {
      const Vec3 weakened = i / 1000.0 * previous;
      nearest = std::min(nearest, (reached - weakened).norm());
      best = std::min(best, std::max(0.0, (wanted - weakened).norm() - step));
    }
    ASSERT_LE(nearest, step + 0.01) << trial;
    ASSERT_NEAR((reached - wanted).norm(), best, 0.01) << trial;
    ASSERT_LE(reached.norm(), 8.0 + 1e-9) << trial;
  }
}

}  // namespace
}  // namespace ream::force
