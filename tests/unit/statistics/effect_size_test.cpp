#include "statistics/effect_size.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "statistics/distributions.hpp"
#include "support/seed.hpp"

namespace ream::statistics {
namespace {

using Values = std::vector<double>;

TEST(EffectSize, WorkedByHand) {
  // Means 4 and 2, variances 1 and 1: d = 2. J of four degrees of freedom is sqrt(2 / pi).
  const auto effect = standardized_difference(Values{3, 4, 5}, Values{1, 2, 3});
  ASSERT_TRUE(effect && effect->g_interval);
  EXPECT_NEAR(effect->cohens_d, 2.0, 1e-12);
  EXPECT_NEAR(effect->hedges_g, 2.0 * std::sqrt(2.0 / std::acos(-1.0)), 1e-12);
  // The bounds are those non-centralities of which t = 2 / sqrt(2/3) leaves 2.5 % on either side.
  const double t = 2.0 / std::sqrt(2.0 / 3.0), to_shift = 1.0 / std::sqrt(2.0 / 3.0);
  EXPECT_NEAR(noncentral_t_cdf(t, 4.0, effect->d_interval->low * to_shift), 0.975, 1e-9);
  EXPECT_NEAR(noncentral_t_cdf(t, 4.0, effect->d_interval->high * to_shift), 0.025, 1e-9);
  EXPECT_NEAR(effect->g_interval->low / effect->d_interval->low, effect->hedges_g / effect->cohens_d, 1e-12);
}

TEST(EffectSize, GIsNotBiasedAndItsIntervalHoldsTheTruth) {
  std::mt19937 random(test::seed(75));
  std::normal_distribution<double> bell;
  constexpr int trials = 2000;
  constexpr double truth = 0.8;
  double sum_g = 0.0;
  int held = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Values a(6), b(8);
    for (double& v : a) v = truth + bell(random);
    for (double& v : b) v = bell(random);
    const auto effect = standardized_difference(a, b);
    sum_g += effect->hedges_g;
    held += effect->d_interval->low <= truth && truth <= effect->d_interval->high ? 1 : 0;
  }
  // The error of one g is about 0.57, of the mean 0.013.
  EXPECT_NEAR(sum_g / trials, truth, 0.05);
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.02);
}

TEST(EffectSize, GroupsTurnedRoundChangeTheSign) {
  const Values a{1, 3, 4, 8}, b{2, 5, 9, 10, 12};
  const auto one = standardized_difference(a, b), two = standardized_difference(b, a);
  EXPECT_NEAR(one->hedges_g, -two->hedges_g, 1e-12);
  EXPECT_NEAR(one->g_interval->low, -two->g_interval->high, 1e-9);
  EXPECT_NEAR(cliffs_delta(a, b)->delta, -cliffs_delta(b, a)->delta, 1e-12);
}

TEST(EffectSize, CliffsDeltaIsCountedByPairs) {
  // Of 12 pairs the first is larger in 3 (5 over 1, 2, 4), smaller in 8, equal in 1.
  const auto delta = cliffs_delta(Values{1, 0, 5}, Values{1, 2, 4, 6});
  EXPECT_NEAR(delta->delta, (3.0 - 8.0) / 12.0, 1e-12);
  ASSERT_TRUE(delta->interval);
  EXPECT_GE(delta->interval->low, -1.0);
}

TEST(EffectSize, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_NE(standardized_difference(Values{1}, Values{1, 2}).note.find("two values or more"),
            std::string::npos);
  EXPECT_NE(standardized_difference(Values{1, 1}, Values{2, 2}).note.find("no unit"), std::string::npos);
  EXPECT_NE(standardized_difference(Values(3, 1.87), Values(14, 1.87)).note.find("no unit"),
            std::string::npos);
  const auto large = standardized_difference(Values{0, 0.001, 0.002}, Values{10, 10.001, 10.002});
  EXPECT_TRUE(large && !large->d_interval);
  EXPECT_NE(large.note.find("too large"), std::string::npos);
  EXPECT_NE(cliffs_delta(Values{1}, Values{2}).note.find("two values"), std::string::npos);
}

}  // namespace
}  // namespace ream::statistics
