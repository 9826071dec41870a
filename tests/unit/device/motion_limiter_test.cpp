#include "device/admittance/motion_limiter.hpp"

#include <gtest/gtest.h>

#include "core/clock.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::device {
namespace {

constexpr MotionLimits limits{250.0, 2500.0, 1.0, 10.0, 100.0};

/// Follows a limiter and holds every set point against the limits.
struct Watch {
  explicit Watch(const MotionLimiter& limiter) : limiter_(limiter), before_(limiter.now()) {}

  void tick() {
    const Pose& now = limiter_.now();
    const Vec3 v = (now.translation_mm - before_.translation_mm) / tick_s;
    const Vec3 w = turn_between(before_.rotation, now.rotation) / tick_s;
    EXPECT_LE(v.norm(), limits.speed_max_mm_s * (1 + 1e-9));
    EXPECT_LE((v - velocity_).norm(), limits.acceleration_max_mm_s2 * tick_s * (1 + 1e-6));
    EXPECT_LE(w.norm(), limits.turn_rate_max_rad_s * (1 + 1e-6));
    EXPECT_LE(now.translation_mm.norm(), limits.reach_mm + 1e-9);
    velocity_ = v;
    before_ = now;
  }

  const MotionLimiter& limiter_;
  Pose before_;
  Vec3 velocity_ = Vec3::Zero();
};

TEST(MotionLimiter, FollowsExactlyWhatKeepsToTheLimits) {
  MotionLimiter limiter(limits);
  limiter.begin(Pose{});
  for (int i = 0; i < 2000; ++i) {
    Pose wanted;
    const double t_s = i * tick_s;
    wanted.translation_mm = {2.0 * (1.0 - std::cos(10.0 * t_s)), 0.5 * t_s * t_s, 0.0};
    limiter.toward(wanted);
    ASSERT_LT((limiter.now().translation_mm - wanted.translation_mm).norm(), 1e-9) << i;
  }
}

TEST(MotionLimiter, GoesToAJumpWithoutOvershootAndRests) {
  MotionLimiter limiter(limits);
  limiter.begin(Pose{});
  Watch watch(limiter);
  const Pose wanted{rotation_from_small_vector({0.0, 0.3, 0.0}), Vec3(60.0, -20.0, 10.0)};
  double farthest = 0.0;
  // What it wants jumps in one tick, which alone asks for 65 m/s; it is there in little more than 0.35 s.
  for (int i = 0; i < 1000; ++i) {
    limiter.toward(wanted);
    watch.tick();
    farthest = std::max(farthest, limiter.now().translation_mm.dot(wanted.translation_mm.normalized()));
  }
  EXPECT_LT((limiter.now().translation_mm - wanted.translation_mm).norm(), 1e-3);
  EXPECT_LT(turn_between(limiter.now().rotation, wanted.rotation).norm(), 1e-3);
  EXPECT_LT(farthest, wanted.translation_mm.norm() + 0.05);
}

TEST(MotionLimiter, BrakesToRestWithinItsTime) {
  MotionLimiter limiter(limits);
  limiter.begin(Pose{});
  Watch watch(limiter);
  Pose wanted;
  for (int i = 0; i < 200; ++i) {
    wanted.translation_mm.x() += 0.25;
    limiter.toward(wanted);
    watch.tick();
  }
  EXPECT_NEAR(limiter.velocity_mm_s().norm(), limits.speed_max_mm_s, 1e-6);
  int ticks = 0;
  for (; !limiter.at_rest() && ticks < 1000; ++ticks) {
    limiter.brake();
    watch.tick();
  }
  EXPECT_LE(ticks * tick_s, limits.stop_time_s() + 2 * tick_s);
}

TEST(MotionLimiter, StaysWithinReachWhateverIsWanted) {
  std::mt19937 random(test::seed(5));
  for (int run = 0; run < 50; ++run) {
    MotionLimiter limiter(limits);
    limiter.begin(Pose{});
    Watch watch(limiter);
    Pose wanted;
    for (int i = 0; i < 3000; ++i) {
      if (i % 300 == 0) wanted = test::random_pose(random, 400.0);
      limiter.toward(wanted);
      watch.tick();
    }
  }
}

}  // namespace
}  // namespace ream::device
