#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <random>
#include <vector>

#include "statistics/correlation.hpp"
#include "statistics/effect_size.hpp"
#include "statistics/mean_tests.hpp"
#include "statistics/proportion.hpp"
#include "statistics/rank_test.hpp"
#include "statistics/roc.hpp"
#include "support/seed.hpp"

namespace ream::statistics {
namespace {

using Values = std::vector<double>;

constexpr int trials_without_effect = 1000;

class FalseAlarms : public testing::Test {
 protected:
  Values drawn(size_t n) {
    Values values(n);
    for (double& v : values) v = bell_(random_);
    return values;
  }
  /// Values of an arm without an effect: what was there before comes back in part.
  ArmValues drawn_arm(size_t n) {
    ArmValues arm{drawn(n), drawn(n)};
    for (size_t i = 0; i < n; ++i) arm.after[i] += 0.7 * arm.before[i];
    return arm;
  }
  /// 1,000 trials without an effect: 5 +- 1.5 % are called one.
  void expect_five_percent(const std::function<bool()>& positive) {
    int alarms = 0;
    for (int trial = 0; trial < trials_without_effect; ++trial) alarms += positive() ? 1 : 0;
    std::cout << 100.0 * alarms / trials_without_effect << " % positive\n";
    EXPECT_NEAR(100.0 * alarms / trials_without_effect, 5.0, 1.5);
  }

  std::mt19937 random_{test::seed(20)};
  std::normal_distribution<double> bell_;
};

TEST_F(FalseAlarms, OfWelchsTest) {
  expect_five_percent([&] {
    Values wide = drawn(14);
    for (double& v : wide) v *= 3.0;
    return welch_test(drawn(10), wide)->p < 0.05;
  });
}

TEST_F(FalseAlarms, OfTheMannWhitneyTest) {
  // Exact: p at most 0.05 comes with 4.3 % of 10 and 10.
  expect_five_percent([&] { return mann_whitney_test(drawn(10), drawn(10))->p <= 0.05; });
}

TEST_F(FalseAlarms, OfTheMannWhitneyTestWithTies) {
  const auto rounded = [&](size_t n) {
    Values values = drawn(n);
    for (double& v : values) v = std::round(2.0 * v);
    return values;
  };
  expect_five_percent([&] { return mann_whitney_test(rounded(25), rounded(25))->p < 0.05; });
}

TEST_F(FalseAlarms, OfThePairedTest) {
  expect_five_percent([&] {
    const Values before = drawn(10), change = drawn(10);
    Values after = before;
    for (size_t i = 0; i < after.size(); ++i) after[i] += change[i];
    return paired_test(before, after)->p < 0.05;
  });
}

TEST_F(FalseAlarms, OfTheDifferenceInChange) {
  expect_five_percent([&] { return difference_in_change(drawn_arm(10), drawn_arm(12))->p < 0.05; });
}

TEST_F(FalseAlarms, OfTheAnalysisOfCovariance) {
  expect_five_percent([&] { return covariance_adjusted(drawn_arm(10), drawn_arm(12))->p < 0.05; });
}

TEST_F(FalseAlarms, OfPearsonsCorrelation) {
  expect_five_percent([&] { return pearson(drawn(12), drawn(12))->p < 0.05; });
}

TEST_F(FalseAlarms, OfSpearmansCorrelation) {
  expect_five_percent([&] { return spearman(drawn(15), drawn(15))->p < 0.05; });
}

TEST_F(FalseAlarms, OfTheBinomialTest) {
  // Of 17 choices at most 4 or at least 13 come with 4.9 %.
  std::binomial_distribution<int> right(17, 0.5);
  expect_five_percent(
      [&] { return binomial_test(static_cast<size_t>(right(random_)), 17)->p_two_sided <= 0.05; });
}

TEST_F(FalseAlarms, OfIntervalsThatDoNotHoldNoEffect) {
  expect_five_percent([&] {
    const Interval g = *standardized_difference(drawn(10), drawn(10))->g_interval;
    return g.low > 0.0 || g.high < 0.0;
  });
  // DeLong's is a large-sample interval: a hundred in each group.
  expect_five_percent([&] {
    const Interval area = *roc_area(drawn(100), drawn(100), {.samples = 1})->interval;
    return area.low > 0.5 || area.high < 0.5;
  });
}

}  // namespace
}  // namespace ream::statistics
