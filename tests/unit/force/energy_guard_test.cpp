#include "force/hand_safety.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/clock.hpp"
#include "force/wrench.hpp"
#include "support/seed.hpp"

namespace ream::force {
namespace {

Pose at_depth(double z_mm) { return {Mat3::Identity(), Vec3(0, 0, z_mm)}; }

/// A spring that pushes out of the half space z > 0.
Wrench wall(double stiffness_n_mm, double z_mm) {
  return {Vec3(0, 0, -stiffness_n_mm * std::max(0.0, z_mm)), Vec3::Zero()};
}

double stored_mj(double stiffness_n_mm, double z_mm) {
  return 0.5 * stiffness_n_mm * std::max(0.0, z_mm) * std::max(0.0, z_mm);
}

TEST(EnergyGuard, LeavesAQuietHandAlone) {
  EnergyGuard guard;
  const double k = 2.0;
  for (int i = 0; i < 4000; ++i) {
    // In and out again by 2 mm within 4 s.
    const double z_mm = 2.0 - std::abs(i - 2000) / 1000.0;
    guard.observe(at_depth(z_mm));
    const Wrench rendered = guard.allow(wall(k, z_mm), stored_mj(k, z_mm));
    ASSERT_EQ(rendered.force_n, wall(k, z_mm).force_n) << i;
  }
  EXPECT_EQ(guard.weakened_ticks(), 0u);
}

TEST(EnergyGuard, CountsWhatAHeldForceTakesAndGives) {
  EnergyGuard guard;
  guard.observe(at_depth(0.0));
  guard.allow({Vec3(0, 0, -2), Vec3::Zero()}, 100.0);
  guard.observe(at_depth(0.3));
  EXPECT_NEAR(guard.energy_mj(), 0.6, 1e-12);
  guard.allow({Vec3(0, 0, -1), Vec3::Zero()}, 100.0);
  guard.observe(at_depth(0.1));
  EXPECT_NEAR(guard.energy_mj(), 0.4, 1e-12);
}

TEST(EnergyGuard, CountsTurning) {
  EnergyGuard guard;
  guard.observe({});
  guard.allow({Vec3::Zero(), Vec3(0, 50, 0)}, 100.0);
  guard.observe({rotation_from_small_vector(Vec3(0, -0.01, 0)), Vec3::Zero()});
  EXPECT_NEAR(guard.energy_mj(), 0.5, 1e-9);
}

TEST(EnergyGuard, SurvivesAHandleThatTurnsRoundInATick) {
  EnergyGuard guard;
  guard.observe({});
  guard.allow({Vec3::Zero(), Vec3(5, 5, 5)}, 100.0);
  Mat3 half_turn;
  half_turn << -1, 0, 0, 0, -1, 0, 0, 0, 1;
  guard.observe({half_turn, Vec3::Zero()});
  EXPECT_LE(std::abs(guard.energy_mj()), 5.0 * std::sqrt(3.0) * 3.1416);
}

/// The adversary: a handle of random acceleration up to what is assumed, on walls of any stiffness, that
/// likes to reverse where it pays. Without the guard such hands draw energy without end.
TEST(EnergyGuard, NoHandDrawsMoreThanTheCredit) {
  const uint32_t seed = test::seed(11);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  double lowest_mj = 0.0, lowest_unguarded_mj = 0.0;
  for (int hand = 0; hand < 500; ++hand) {
    const double k = std::exp(3.0 * one(random));  // 0.05 to 20 N/mm
    EnergyGuard guard;
    double z_mm = -1.0, speed_mm_s = 0.0, unguarded_mj = 0.0;
    Wrench unguarded;
    for (int i = 0; i < 1000; ++i) {
      const double wish = z_mm > 0.0 ? -1.0 : 1.0;
      const double gain = energy_guard::speed_gain_mm_s * std::clamp(wish + one(random), -1.0, 1.0);
      speed_mm_s = std::clamp(speed_mm_s + gain, -1000.0, 1000.0);
      z_mm += speed_mm_s * tick_s;
      guard.observe(at_depth(z_mm));
      unguarded_mj -= unguarded.force_n.z() * speed_mm_s * tick_s;
      lowest_mj = std::min(lowest_mj, guard.energy_mj());
      lowest_unguarded_mj = std::min(lowest_unguarded_mj, unguarded_mj);
      unguarded = wall(k, z_mm);
      const Wrench rendered = guard.allow(unguarded, stored_mj(k, z_mm));
      ASSERT_LE(rendered.force_n.norm(), unguarded.force_n.norm() + 1e-12);
      ASSERT_LE(rendered.force_n.z(), 0.0);
    }
  }
  EXPECT_GE(lowest_mj, -1.0);
  EXPECT_LT(lowest_unguarded_mj, -20.0) << "the hands were no test";
}

TEST(EnergyGuard, WhatTheBoneUsedUpDoesNotPayLater) {
  EnergyGuard guard;
  const double k = 2.0;
  // Pressing with 4 N through 50 mm of something that only yields: 200 mJ are put in, 4 mJ are stored.
  double z_mm = 0.0;
  for (int i = 0; i < 5000; ++i) {
    z_mm += 0.01;
    guard.observe(at_depth(z_mm));
    guard.allow({Vec3(0, 0, -4), Vec3::Zero()}, 0.5 * 16.0 / k);
  }
  ASSERT_GT(guard.energy_mj(), 190.0);
  // A source of force that pushes the hand all the way back is stopped.
  double given_mj = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const Wrench rendered = guard.allow({Vec3(0, 0, -4), Vec3::Zero()}, 0.0);
    z_mm -= 0.01;
    given_mj -= rendered.force_n.z() * 0.01;
    guard.observe(at_depth(z_mm));
  }
  EXPECT_LT(given_mj, energy_guard::max_saved_mj + 4.0 + 1.0);
}

}  // namespace
}  // namespace ream::force
