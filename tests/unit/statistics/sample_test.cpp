#include "statistics/sample.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "support/seed.hpp"

namespace ream::statistics {
namespace {

TEST(Sample, MeanAndSpread) {
  // Squares about 5: 9 + 1 + 1 + 1 + 0 + 0 + 4 + 16 = 32.
  const std::array values{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  EXPECT_DOUBLE_EQ(mean_of(values), 5.0);
  EXPECT_DOUBLE_EQ(spread_of(values).sd, std::sqrt(32.0 / 7.0));
  EXPECT_EQ(mean_of({}), 0.0);
}

TEST(Sample, EqualValuesDoNotSpread) {
  for (size_t n = 2; n <= 40; ++n) {
    const std::vector<double> values(n, 1.87);
    EXPECT_EQ(spread_of(values).sd, 0.0) << n;
    EXPECT_EQ(spread_of(values).mean, 1.87) << n;
    EXPECT_EQ(mean_of(values), 1.87) << n;
    const auto mean = mean_estimate(values);
    EXPECT_TRUE(mean && !mean->interval) << n;
    EXPECT_EQ(mean->mean, 1.87) << n;
    EXPECT_NE(mean.note.find("all values are equal"), std::string::npos) << mean.note;
  }
}

TEST(Sample, MedianAndQuantiles) {
  EXPECT_EQ(median_of(std::array{3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median_of(std::array{4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_EQ(quantile({1.0, 2.0, 3.0, 4.0, 5.0}, 0.25), 2.0);
  EXPECT_EQ(quantile({1.0, 2.0}, 0.75), 1.75);
  EXPECT_EQ(quantile({7.0}, 1.0), 7.0);
}

TEST(Sample, EqualValuesShareTheirRanks) {
  EXPECT_EQ(ranks_of(std::array{3.0, 1.0, 3.0, 2.0, 3.0}), (std::vector<double>{4, 1, 4, 2, 4}));
}

TEST(Sample, HolmsAdjustmentWorkedByHand) {
  // 4 x 0.005; 3 x 0.01; 2 x 0.03; then 0.04 is no smaller than the one before.
  const std::vector<double> adjusted = adjusted_by_holm(std::array{0.01, 0.04, 0.03, 0.005});
  const std::array expected{0.03, 0.06, 0.06, 0.02};
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-12);
  EXPECT_EQ(adjusted_by_holm(std::array{0.6, 0.7}), (std::vector<double>{1.0, 1.0}));
}

TEST(Sample, AMeanHasItsTInterval) {
  // Student's sleep data, differences: mean 1.58, interval 0.7001142 to 2.4598858.
  const std::array gains{1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
  const auto mean = mean_estimate(gains);
  ASSERT_TRUE(mean && mean->interval);
  EXPECT_NEAR(mean->mean, 1.58, 1e-12);
  EXPECT_NEAR(mean->interval->low, 0.7001142, 1e-7);
  EXPECT_NEAR(mean->interval->high, 2.4598858, 1e-7);
}

TEST(Sample, TooFewValuesAreAnsweredInWords) {
  EXPECT_FALSE(mean_estimate({}));
  const auto one = mean_estimate(std::array{3.0});
  EXPECT_TRUE(one && !one->interval);
  EXPECT_EQ(one.note, "one value has no interval");
  const auto five = median_estimate(std::array{1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_TRUE(five && !five->interval);
  EXPECT_NE(five.note.find("5 values has no interval"), std::string::npos) << five.note;
}

TEST(Sample, AMediansIntervalIsThatOfPrintedTables) {
  // Least n of the k-th order statistic at 95 %, from tables of the sign test: 6, 9, 12, 15, 17, 20.
  const std::array<size_t, 6> least{6, 9, 12, 15, 17, 20};
  for (size_t n = 6; n <= 22; ++n) {
    std::vector<double> values(n);
    for (size_t i = 0; i < n; ++i) values[i] = static_cast<double>(i + 1);
    size_t k = 0;
    while (k < least.size() && least[k] <= n) ++k;
    const auto median = median_estimate(values);
    ASSERT_TRUE(median && median->interval) << n;
    EXPECT_EQ(median->interval->low, static_cast<double>(k)) << n;
    EXPECT_EQ(median->interval->high, static_cast<double>(n + 1 - k)) << n;
    EXPECT_GE(median->coverage, 0.95);
  }
}

TEST(Sample, IntervalsHoldWhatTheySay) {
  std::mt19937 random(test::seed(71));
  std::exponential_distribution<double> value(1.0);
  std::normal_distribution<double> bell;
  int held_mean = 0, held_median = 0;
  double coverage = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::array<double, 12> bells, skewed;
    for (double& v : bells) v = bell(random);
    for (double& v : skewed) v = value(random);
    const Interval mean = *mean_estimate(bells)->interval;
    const auto median = median_estimate(skewed);
    coverage = median->coverage;
    held_mean += mean.low <= 0.0 && 0.0 <= mean.high ? 1 : 0;
    held_median += median->interval->low <= std::log(2.0) && std::log(2.0) <= median->interval->high ? 1 : 0;
  }
  // Four standard errors of 4000 trials at 95 % are 1.4 %.
  EXPECT_NEAR(held_mean / 4000.0, 0.95, 0.014);
  EXPECT_NEAR(held_median / 4000.0, coverage, 0.014);
}

}  // namespace
}  // namespace ream::statistics
