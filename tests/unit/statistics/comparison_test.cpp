#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "statistics/correlation.hpp"
#include "statistics/mean_tests.hpp"
#include "statistics/rank_test.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::statistics {
namespace {

using Values = std::vector<double>;

/// Hours of sleep gained with two drugs by the same ten people (Student 1908).
const Values drug_one = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const Values drug_two = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

TEST(WelchTest, StudentsSleepData) {
  // As R's t.test(extra ~ group, data = sleep) prints.
  const auto test = welch_test(drug_one, drug_two);
  ASSERT_TRUE(test);
  EXPECT_NEAR(test->t, -1.8608, 0.00005);
  EXPECT_NEAR(test->freedom, 17.776, 0.0005);
  EXPECT_NEAR(test->p, 0.07939, 0.000005);
  EXPECT_NEAR(test->interval.low, -3.3654832, 1e-7);
  EXPECT_NEAR(test->interval.high, 0.2054832, 1e-7);
}

TEST(PairedTest, StudentsSleepData) {
  const auto test = paired_test(drug_one, drug_two);
  ASSERT_TRUE(test);
  EXPECT_NEAR(test->t, 4.0621, 0.00005);
  EXPECT_NEAR(test->p, 0.002833, 0.0000005);
  EXPECT_NEAR(test->interval.low, 0.7001142, 1e-7);
  EXPECT_NEAR(test->interval.high, 2.4598858, 1e-7);
}

TEST(DifferenceInChange, IsWelchsTestOfTheGains) {
  const ArmValues first{{1, 2, 3, 4}, {3, 5, 4, 8}}, second{{2, 2, 5}, {2, 3, 7}};
  const auto gains = welch_test(Values{2, 3, 1, 4}, Values{0, 1, 2});
  const auto change = difference_in_change(first, second);
  EXPECT_DOUBLE_EQ(change->difference, gains->difference);
  EXPECT_DOUBLE_EQ(change->p, gains->p);
}

/// Least squares of y on columns by the normal equations, with the error of the last one.
std::pair<double, double> last_coefficient(const std::vector<std::array<double, 3>>& x, const Values& y) {
  double a[3][6] = {};
  for (size_t r = 0; r < y.size(); ++r)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) a[i][j] += x[r][i] * x[r][j];
  for (int i = 0; i < 3; ++i) a[i][3 + i] = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double pivot = a[i][i];
    for (double& v : a[i]) v /= pivot;
    for (int r = 0; r < 3; ++r) {
      if (r == i) continue;
      const double factor = a[r][i];
      for (int c = 0; c < 6; ++c) a[r][c] -= factor * a[i][c];
    }
  }
  double b[3] = {}, xy[3] = {};
  for (size_t r = 0; r < y.size(); ++r)
    for (int i = 0; i < 3; ++i) xy[i] += x[r][i] * y[r];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) b[i] += a[i][3 + j] * xy[j];
  double squares = 0.0;
  for (size_t r = 0; r < y.size(); ++r) {
    const double off = y[r] - b[0] * x[r][0] - b[1] * x[r][1] - b[2] * x[r][2];
    squares += off * off;
  }
  return {b[2], std::sqrt(squares / static_cast<double>(y.size() - 3) * a[2][5])};
}

TEST(CovarianceAdjusted, IsTheRegressionOnBeforeAndArm) {
  std::mt19937 random(test::seed());
  std::normal_distribution<double> bell;
  for (int trial = 0; trial < 50; ++trial) {
    ArmValues first, second;
    std::vector<std::array<double, 3>> x;
    Values y;
    for (int i = 0; i < 13; ++i) {
      const double before = bell(random), after = 0.6 * before + bell(random);
      ArmValues& arm = i < 6 ? first : second;
      arm.before.push_back(before);
      arm.after.push_back(after);
      x.push_back({1.0, before, i < 6 ? 1.0 : 0.0});
      y.push_back(after);
    }
    const auto [effect, error] = last_coefficient(x, y);
    const auto test = covariance_adjusted(first, second);
    EXPECT_NEAR(test->difference, effect, 1e-9);
    EXPECT_NEAR(test->t, effect / error, 1e-7);
    EXPECT_EQ(test->freedom, 10.0);
  }
}

TEST(MannWhitneyTest, HollanderAndWolfesExample) {
  // Nonparametric Statistical Methods, p. 69: permeability at term and at 12 to 26 weeks; one-sided p 0.1272.
  const auto test = mann_whitney_test(Values{0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46},
                                      Values{1.15, 0.88, 0.90, 0.74, 1.21});
  ASSERT_TRUE(test);
  EXPECT_TRUE(test->exact);
  EXPECT_EQ(test->u, 35.0);
  EXPECT_NEAR(test->p, 2.0 * 0.1272, 0.0001);
}

/// Two-sided p by looking at every way to choose the first group.
double p_by_all_choices(const Values& all, size_t first) {
  const size_t n = all.size();
  std::vector<int> chosen(n, 0);
  std::fill(chosen.end() - static_cast<long>(first), chosen.end(), 1);
  const auto u_of = [&](const std::vector<int>& of_first) {
    double u = 0.0;
    for (size_t i = 0; i < n; ++i)
      for (size_t j = 0; j < n; ++j)
        if (of_first[i] == 1 && of_first[j] == 0) u += all[i] > all[j] ? 1.0 : all[i] == all[j] ? 0.5 : 0.0;
    return u;
  };
  std::vector<int> given(n, 0);
  std::fill(given.begin(), given.begin() + static_cast<long>(first), 1);
  const double u = u_of(given);
  double low = 0.0, high = 0.0, ways = 0.0;
  do {
    const double here = u_of(chosen);
    low += here <= u ? 1.0 : 0.0;
    high += here >= u ? 1.0 : 0.0;
    ways += 1.0;
  } while (std::next_permutation(chosen.begin(), chosen.end()));
  return std::min(1.0, 2.0 * std::min(low, high) / ways);
}

TEST(MannWhitneyTest, IsExactWithoutTies) {
  std::mt19937 random(test::seed());
  std::normal_distribution<double> bell;
  for (const auto& [m, n] : {std::pair<size_t, size_t>{1, 1}, {3, 4}, {4, 4}, {2, 7}, {6, 5}})
    for (int trial = 0; trial < 10; ++trial) {
      Values first(m), second(n);
      for (double& v : first) v = bell(random);
      for (double& v : second) v = bell(random);
      Values all = first;
      all.insert(all.end(), second.begin(), second.end());
      EXPECT_NEAR(mann_whitney_test(first, second)->p, p_by_all_choices(all, m), 1e-12) << m << " " << n;
    }
}

TEST(MannWhitneyTest, WithTiesItIsNearTheExactOne) {
  std::mt19937 random(test::seed(79));
  std::uniform_int_distribution<int> value(0, 5);
  for (int trial = 0; trial < 20; ++trial) {
    Values first(8), second(8);
    for (double& v : first) v = value(random) + trial % 3;
    for (double& v : second) v = value(random);
    Values all = first;
    all.insert(all.end(), second.begin(), second.end());
    const auto test = mann_whitney_test(first, second);
    EXPECT_FALSE(test->exact);
    const double exact = p_by_all_choices(all, first.size());
    EXPECT_NEAR(test->p, exact, std::max(0.02, 0.1 * exact));
  }
}

TEST(MannWhitneyTest, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_NE(mann_whitney_test(Values{1, 1}, Values{1}).note.find("all values are equal"), std::string::npos);
  EXPECT_NE(mann_whitney_test(Values{}, Values{1}).note.find("a value or more"), std::string::npos);
}

TEST(Correlations, WorkedByHand) {
  // x about 3: -2..2; y about 3: Sxy 8, Sxx 10, Syy 10.
  const Values x{1, 2, 3, 4, 5}, y{2, 1, 4, 3, 5};
  const auto pearson_r = pearson(x, y);
  EXPECT_NEAR(pearson_r->r, 0.8, 1e-12);
  const double z = std::atanh(0.8), reach = 1.959964 / std::sqrt(2.0);
  EXPECT_NEAR(pearson_r->interval->low, std::tanh(z - reach), 1e-6);
  EXPECT_NEAR(pearson_r->interval->high, std::tanh(z + reach), 1e-6);
  // The same values are their ranks; ranks do not care for a rising function.
  EXPECT_NEAR(spearman(x, y)->r, 0.8, 1e-12);
  EXPECT_NEAR(
      spearman(x, Values{std::exp(2.0), std::exp(1.0), std::exp(4.0), std::exp(3.0), std::exp(5.0)})->r, 0.8,
      1e-12);
  EXPECT_FALSE(spearman(x, y)->interval);
}

TEST(Correlations, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_NE(pearson(Values{1, 2}, Values{1, 2}).note.find("three pairs"), std::string::npos);
  EXPECT_NE(pearson(Values{1, 2, 3}, Values{2, 2, 2}).note.find("are equal"), std::string::npos);
  EXPECT_NE(pearson(Values{1, 2, 3}, Values{1, 3, 2}).note.find("four pairs"), std::string::npos);
  const auto line = pearson(Values{1, 2, 3, 4}, Values{2, 4, 6, 8});
  EXPECT_NEAR(line->r, 1.0, 1e-12);
  EXPECT_EQ(line->p, 0.0);
  EXPECT_FALSE(line->interval);
  test::expect_error(ErrorKind::invalid_input, "as many", [] { (void)pearson(Values{1, 2}, Values{1}); });
}

TEST(MeanTests, WhatDiffersByRoundingIsEqual) {
  const Values three(3, 1.87), fourteen(14, 1.87);
  EXPECT_NE(welch_test(three, fourteen).note.find("equal"), std::string::npos);
  // All gain 0.1, but for rounding.
  const ArmValues gained{{2.0, 1.0, 0.3, 1.87}, {2.1, 1.1, 0.4, 1.97}};
  ASSERT_NE(2.1 - 2.0, 0.4 - 0.3);
  EXPECT_NE(paired_test(gained.before, gained.after).note.find("all changes are equal"), std::string::npos);
  EXPECT_NE(difference_in_change(gained, gained).note.find("equal"), std::string::npos);
  // A third to 12 digits, and whole numbers.
  EXPECT_FALSE(paired_test(Values{0.333333333333, 2.0}, Values{1.33333333333, 3.0}));
  EXPECT_TRUE(paired_test(Values{2.0, 1.0}, Values{2.1, 1.100001}));
  const ArmValues still{three, {1.0, 2.0, 4.0}}, others{fourteen, Values(14, 3.0)};
  EXPECT_NE(covariance_adjusted(still, others).note.find("explain nothing"), std::string::npos);
}

TEST(MeanTests, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_NE(welch_test(Values{1}, Values{1, 2}).note.find("two values"), std::string::npos);
  EXPECT_NE(welch_test(Values{1, 1}, Values{2, 2}).note.find("equal"), std::string::npos);
  EXPECT_NE(paired_test(Values{1}, Values{2}).note.find("two pairs"), std::string::npos);
  EXPECT_NE(paired_test(Values{1, 2}, Values{2, 3}).note.find("all changes are equal"), std::string::npos);
  EXPECT_NE(covariance_adjusted({{1}, {2}}, {{1, 2}, {2, 3}}).note.find("two values or more"),
            std::string::npos);
  EXPECT_NE(covariance_adjusted({{1, 1}, {2, 3}}, {{2, 2}, {2, 3}}).note.find("explain nothing"),
            std::string::npos);
  EXPECT_NE(covariance_adjusted({{1, 2}, {2, 3}}, {{1, 2}, {1, 2}}).note.find("follow wholly"),
            std::string::npos);
  test::expect_error(ErrorKind::invalid_input, "as many", [] { (void)paired_test(Values{1, 2}, Values{1}); });
}

}  // namespace
}  // namespace ream::statistics
