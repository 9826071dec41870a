#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "statistics/learning_fit.hpp"
#include "statistics/regression.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::statistics {
namespace {

using Values = std::vector<double>;

TEST(Regression, WorkedByHand) {
  // x about 2: -1 0 1; y about 2: -1 1 0. Sxx 2, Syy 2, Sxy 1: slope 1/2, rho 1/2.
  const Regression r = regression(Values{1.0, 2.0, 3.0}, Values{1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(r.slope, 0.5);
  EXPECT_DOUBLE_EQ(r.intercept, 1.0);
  EXPECT_DOUBLE_EQ(r.rho, 0.5);
  EXPECT_DOUBLE_EQ(r.r_squared, 0.25);
  // One degree of freedom is Cauchy's: t = 0.5 / sqrt(0.75) = 1/sqrt(3) = tan(30 deg), so p = 1 - 2 * 30/180.
  EXPECT_NEAR(r.p, 2.0 / 3.0, 1e-12);
}

TEST(Regression, AStraightLineLeavesNoDoubt) {
  const Regression r = regression(Values{0.0, 1.0, 2.0, 4.0}, Values{1.0, -1.0, -3.0, -7.0});
  EXPECT_DOUBLE_EQ(r.slope, -2.0);
  EXPECT_DOUBLE_EQ(r.rho, -1.0);
  EXPECT_NEAR(r.p, 0.0, 1e-12);
}

Values attempts_to(int last) {
  Values attempts;
  for (int i = 1; i <= last; ++i) attempts.push_back(i);
  return attempts;
}

double curve_at(double start, double plateau, double rate, double attempt) {
  return plateau + (start - plateau) * std::exp(-rate * (attempt - 1.0));
}

TEST(LearningFit, FindsTheCurveThatThePointsLieOn) {
  for (const double rate : {0.05, 0.4, 1.5}) {
    const Values attempts = attempts_to(12);
    Values values;
    for (const double attempt : attempts) values.push_back(curve_at(180.0, 60.0, rate, attempt));
    const auto fit = learning_fit(attempts, values);
    ASSERT_TRUE(fit) << fit.note;
    EXPECT_NEAR(fit->rate, rate, 1e-5 * rate);
    EXPECT_NEAR(fit->start, 180.0, 1e-2);
    EXPECT_NEAR(fit->plateau, 60.0, 1e-2);
    EXPECT_NEAR(fit->attempts_to_half, std::log(2.0) / rate, 1e-4 / rate);
  }
}

TEST(LearningFit, ItsIntervalsHoldTheTruth) {
  std::mt19937 random(test::seed(76));
  std::normal_distribution<double> noise(0.0, 4.0);
  const Values attempts = attempts_to(25);
  constexpr int trials = 1000;
  int start = 0, plateau = 0, rate = 0, fitted = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Values values;
    for (const double attempt : attempts)
      values.push_back(curve_at(180.0, 60.0, 0.35, attempt) + noise(random));
    const auto fit = learning_fit(attempts, values);
    if (!fit) continue;
    ++fitted;
    const auto holds = [](const Interval& i, double truth) {
      return i.low <= truth && truth <= i.high ? 1 : 0;
    };
    start += holds(fit->start_interval, 180.0);
    plateau += holds(fit->plateau_interval, 60.0);
    rate += holds(fit->rate_interval, 0.35);
  }
  EXPECT_EQ(fitted, trials);
  for (const int held : {start, plateau, rate}) EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.028);
}

TEST(LearningFit, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_NE(learning_fit(attempts_to(4), Values{4, 3, 2, 2}).note.find("five values"), std::string::npos);
  EXPECT_NE(learning_fit(Values{1, 1, 2, 2, 3}, Values{4, 3, 2, 2, 1}).note.find("four attempts"),
            std::string::npos);
  EXPECT_NE(learning_fit(attempts_to(6), Values(6, 2.0)).note.find("all values are equal"),
            std::string::npos);
  // A straight line does not bend.
  EXPECT_NE(learning_fit(attempts_to(6), Values{6, 5, 4, 3, 2, 1}).note.find("do not bend"),
            std::string::npos);
  test::expect_error(ErrorKind::invalid_input, "as many", [] {
    (void)learning_fit(Values{1}, Values{1, 2});
  });
}

}  // namespace
}  // namespace ream::statistics
