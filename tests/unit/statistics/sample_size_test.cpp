#include "statistics/sample_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "statistics/distributions.hpp"
#include "statistics/intraclass.hpp"
#include "statistics/mean_tests.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::statistics {
namespace {

TEST(SampleSize, OfTwoMeansIsThatOfCohensTables) {
  // Statistical Power Analysis, table 2.4.1 (two-sided 5 %, power 0.80): 393, 64, 26.
  EXPECT_EQ(size_for_two_means(0.5), 64u);
  EXPECT_EQ(size_for_two_means(0.8), 26u);
  EXPECT_EQ(size_for_two_means(-0.8), 26u);
  EXPECT_NEAR(static_cast<double>(size_for_two_means(0.2)), 393.5, 0.6);
  // R's power.t.test(n = 20, delta = 1) and (power = 0.90, delta = 1).
  EXPECT_NEAR(power_of_two_means(1.0, 20), 0.8689528, 1e-6);
  EXPECT_EQ(size_for_two_means(1.0, {.power = 0.90}), 23u);
}

TEST(SampleSize, OneLessIsTooFew) {
  for (const double effect : {0.1, 0.37, 1.2, 5.0}) {
    const size_t n = size_for_two_means(effect);
    EXPECT_GE(power_of_two_means(effect, n), 0.8);
    if (n > 2) {
      EXPECT_LT(power_of_two_means(effect, n - 1), 0.8) << effect;
    }
  }
}

TEST(SampleSize, OfTwoSharesIsThatOfTheTextbook) {
  // R's power.prop.test(p1 = 0.50, p2 = 0.75, power = 0.90): 76.7.
  EXPECT_EQ(size_for_two_shares(0.50, 0.75, {.power = 0.90}), 77u);
  EXPECT_EQ(size_for_two_shares(0.75, 0.50, {.power = 0.90}), 77u);
}

TEST(SampleSize, AgreementIsShownAsOftenAsPlanned) {
  // The F test of one-way groups that Walter, Eliasziw & Donner plan for: ICC over 0.6 when it is 0.8.
  constexpr size_t raters = 2;
  const size_t subjects = size_for_agreement_over(0.6, 0.8, raters);
  EXPECT_EQ(subjects, 39u);
  std::mt19937 random(test::seed(77));
  std::normal_distribution<double> bell;
  constexpr int trials = 4000;
  int shown = 0;
  for (int trial = 0; trial < trials; ++trial) {
    double between = 0.0, within = 0.0, sum = 0.0;
    for (size_t i = 0; i < subjects; ++i) {
      const double truth = std::sqrt(0.8) * bell(random);
      const double one = truth + std::sqrt(0.2) * bell(random), two = truth + std::sqrt(0.2) * bell(random);
      const double mean = 0.5 * (one + two);
      within += 2.0 * (one - mean) * (one - mean);
      between += 2.0 * mean * mean;
      sum += mean;
    }
    const double n = static_cast<double>(subjects);
    between -= 2.0 * sum * sum / n;
    const double f = between / (n - 1.0) / (within / n);
    const double limit = (1.0 + 2.0 * 0.6 / 0.4) * f_quantile(0.95, n - 1.0, n);
    shown += f > limit ? 1 : 0;
  }
  // An approximation: planned 0.80, and four standard errors of 4000 trials are 2.5 %.
  EXPECT_NEAR(shown / static_cast<double>(trials), 0.80, 0.04);
}

TEST(SampleSize, AnAgreementsIntervalIsAsWideAsPlanned) {
  constexpr size_t raters = 3;
  const size_t subjects = size_for_agreement_width(0.7, 0.2, raters);
  EXPECT_EQ(subjects, 68u);
  std::mt19937 random(test::seed(78));
  std::normal_distribution<double> bell;
  double width = 0.0;
  constexpr int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<RatingRow> table;
    for (size_t i = 0; i < subjects; ++i) {
      const double truth = std::sqrt(0.7) * bell(random);
      RatingRow row;
      for (size_t j = 0; j < raters; ++j) row.emplace_back(truth + std::sqrt(0.3) * bell(random));
      table.push_back(row);
    }
    const auto icc = intraclass_correlation(table);
    width += (icc->single_interval->high - icc->single_interval->low) / trials;
  }
  EXPECT_NEAR(width, 0.2, 0.02);
  // Two raters from 0.7 on get more.
  EXPECT_EQ(size_for_agreement_width(0.8, 0.2, 2), 55u);
}

TEST(SampleSize, AimsThatCannotBeAreRefused) {
  const ErrorKind kind = ErrorKind::invalid_input;
  test::expect_error(kind, "effect of 0", [] { size_for_two_means(0.0); });
  test::expect_error(kind, "more than a million", [] { size_for_two_means(1e-4); });
  test::expect_error(kind, "power over significance", [] { size_for_two_means(0.5, {.power = 0.04}); });
  test::expect_error(kind, "differ", [] { size_for_two_shares(0.5, 0.5); });
  test::expect_error(kind, "least < expected", [] { size_for_agreement_over(0.8, 0.6, 2); });
  test::expect_error(kind, "two raters", [] { size_for_agreement_width(0.8, 0.2, 1); });
  test::expect_error(kind, "two persons", [] { power_of_two_means(0.8, 1); });
}

}  // namespace
}  // namespace ream::statistics
