#include "core/timing_histogram.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace ream {
namespace {

/// The smallest of the sorted values that at least that share of them do not exceed.
double percentile(const std::vector<double>& sorted, double fraction) {
  const auto rank = static_cast<size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
  return sorted[std::max<size_t>(rank, 1) - 1];
}

TEST(TimingHistogram, AgreesWithSortedTimes) {
  std::mt19937 random(test::seed(51));
  for (const auto& [count, log_us] : {std::pair{1u, 5.0},
                                      {2u, 5.0},
                                      {10u, 5.0},
                                      {999u, 5.0},
                                      {50000u, 5.0},
                                      {999u, 1.0},
                                      {50000u, 1.0},
                                      {50000u, -3.0}}) {
    std::lognormal_distribution<double> time_us(log_us, 1.0);
    auto histogram = std::make_unique<TimingHistogram>();
    std::vector<double> times;
    double sum_us = 0.0;
    for (size_t i = 0; i < count; ++i) {
      times.push_back(std::min(time_us(random), 19000.0));
      histogram->add(times.back());
      sum_us += times.back();
    }
    std::sort(times.begin(), times.end());
    const TimingSummary summary = histogram->summary();
    SCOPED_TRACE("seed 51, " + std::to_string(count) + " times");
    EXPECT_EQ(summary.count, count);
    EXPECT_NEAR(summary.mean_us, sum_us / static_cast<double>(count), 1e-9 * sum_us);
    EXPECT_EQ(summary.max_us, times.back());
    for (const auto& [found, fraction] : {std::pair{summary.p50_us, 0.5}, std::pair{summary.p99_us, 0.99},
                                          std::pair{summary.p999_us, 0.999}}) {
      // An upper edge of its bin.
      const double true_us = percentile(times, fraction);
      EXPECT_GE(found, true_us) << fraction;
      EXPECT_LE(found, true_us + (true_us < 20.0 ? 0.1 : 1.0) + 1e-9) << fraction;
    }
  }
}

TEST(TimingHistogram, NothingTimedIsZero) {
  const auto histogram = std::make_unique<TimingHistogram>();
  const TimingSummary summary = histogram->summary();
  EXPECT_EQ(summary.count, 0u);
  for (const double value :
       {summary.mean_us, summary.p50_us, summary.p99_us, summary.p999_us, summary.max_us})
    EXPECT_EQ(value, 0.0);
}

TEST(TimingHistogram, TimesBeyondItsRangeKeepTheMaximumExact) {
  const auto histogram = std::make_unique<TimingHistogram>();
  for (int i = 0; i < 90; ++i) histogram->add(3.5);
  for (int i = 0; i < 10; ++i) histogram->add(123456.75);
  const TimingSummary summary = histogram->summary();
  EXPECT_EQ(summary.p50_us, 3.6);
  EXPECT_EQ(summary.p99_us, 123456.75);
  EXPECT_EQ(summary.max_us, 123456.75);
}

TEST(TimingHistogram, PercentilesNeverExceedTheMaximum) {
  const auto histogram = std::make_unique<TimingHistogram>();
  histogram->add(7.25);
  EXPECT_EQ(histogram->summary().p50_us, 7.25);
  EXPECT_EQ(histogram->summary().p999_us, 7.25);
}

}  // namespace
}  // namespace ream
