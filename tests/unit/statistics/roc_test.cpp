#include "statistics/roc.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "statistics/proportion.hpp"
#include "support/seed.hpp"

namespace ream::statistics {
namespace {

using Values = std::vector<double>;

/// Ratings 1 to 5 as often as `counts` says.
Values rated(const std::array<int, 5>& counts) {
  Values values;
  for (size_t i = 0; i < counts.size(); ++i)
    values.insert(values.end(), static_cast<size_t>(counts[i]), static_cast<double>(i + 1));
  return values;
}

/// The CT readings of Hanley & McNeil 1982, Radiology 143, table I.
const Values abnormal = rated({3, 2, 2, 11, 33}), normal = rated({33, 6, 6, 11, 2});

TEST(RocArea, TheComputedTomographyTableOfHanleyAndMcNeil) {
  const auto roc = roc_area(abnormal, normal);
  ASSERT_TRUE(roc && roc->interval);
  EXPECT_NEAR(roc->area, 0.893, 0.0005);
  // As Stata's roctab prints for this table, with DeLong's error.
  EXPECT_NEAR(*roc->standard_error, 0.0307, 0.00005);
  EXPECT_NEAR(roc->interval->low, 0.83295, 0.00001);
  EXPECT_NEAR(roc->interval->high, 0.95339, 0.00001);
  // At "probably abnormal" or more: 44 of 51 and 45 of 58.
  EXPECT_EQ(roc->cut.threshold, 4.0);
  EXPECT_TRUE(roc->cut.at_least);
  EXPECT_DOUBLE_EQ(roc->cut.sensitivity, 44.0 / 51.0);
  EXPECT_DOUBLE_EQ(roc->cut.specificity, 45.0 / 58.0);
  EXPECT_NEAR(roc->cut.youden_j, 44.0 / 51.0 + 45.0 / 58.0 - 1.0, 1e-12);
  EXPECT_EQ(roc->cut.sensitivity_interval.low, wilson_interval(44, 51).low);
}

TEST(RocArea, IsCountedByPairs) {
  std::mt19937 random(test::seed());
  std::uniform_int_distribution<int> value(0, 6), size(2, 12);
  for (int trial = 0; trial < 200; ++trial) {
    Values group(static_cast<size_t>(size(random))), others(static_cast<size_t>(size(random)));
    for (double& v : group) v = value(random);
    for (double& v : others) v = value(random);
    double wins = 0.0;
    for (const double g : group)
      for (const double o : others) wins += g > o ? 1.0 : g == o ? 0.5 : 0.0;
    const auto roc = roc_area(group, others, {.samples = 1});
    EXPECT_NEAR(roc->area, wins / static_cast<double>(group.size() * others.size()), 1e-12);
    // Groups and directions turned round.
    EXPECT_NEAR(roc_area(others, group, {.samples = 1})->area, 1.0 - roc->area, 1e-12);
    // No cut is better than the best.
    for (int cut = 0; cut <= 6; ++cut) {
      double hits = 0.0, rejected = 0.0;
      for (const double g : group) hits += (roc->cut.at_least ? g >= cut : g <= cut) ? 1.0 : 0.0;
      for (const double o : others) rejected += (roc->cut.at_least ? o >= cut : o <= cut) ? 0.0 : 1.0;
      EXPECT_GE(roc->cut.youden_j + 1e-12, hits / static_cast<double>(group.size()) +
                                               rejected / static_cast<double>(others.size()) - 1.0);
    }
  }
}

TEST(RocArea, TheBootstrapIsSeededAndLiesNearDeLongs) {
  const Bootstrap bootstrap{.seed = 5, .samples = 4000};
  const auto one = roc_area(abnormal, normal, bootstrap), two = roc_area(abnormal, normal, bootstrap);
  ASSERT_TRUE(one->bootstrap && two->bootstrap);
  EXPECT_EQ(one->bootstrap->low, two->bootstrap->low);
  EXPECT_EQ(one->bootstrap->high, two->bootstrap->high);
  const auto other = roc_area(abnormal, normal, {.seed = 6, .samples = 4000});
  EXPECT_NE(one->bootstrap->low, other->bootstrap->low);
  EXPECT_NEAR(one->bootstrap->low, one->interval->low, 0.01);
  EXPECT_NEAR(one->bootstrap->high, one->interval->high, 0.01);
}

TEST(RocArea, ItsIntervalsHoldTheTruth) {
  // Normal values one apart: area Phi(1 / sqrt 2).
  const double truth = 0.5 * std::erfc(-0.5);
  std::mt19937 random(test::seed(74));
  std::normal_distribution<double> bell;
  constexpr int trials = 1000;
  int held = 0, held_bootstrap = 0;
  for (int trial = 0; trial < trials; ++trial) {
    Values group(40), others(40);
    for (double& v : group) v = 1.0 + bell(random);
    for (double& v : others) v = bell(random);
    const auto roc = roc_area(group, others, {.seed = 1, .samples = 500});
    held += roc->interval->low <= truth && truth <= roc->interval->high ? 1 : 0;
    held_bootstrap += roc->bootstrap->low <= truth && truth <= roc->bootstrap->high ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.03);
  EXPECT_NEAR(held_bootstrap / static_cast<double>(trials), 0.95, 0.03);
}

TEST(RocArea, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_NE(roc_area(Values{1}, Values{1, 2}).note.find("two values or more"), std::string::npos);
  const auto apart = roc_area(Values{5, 6, 7, 8, 9}, Values{1, 2, 3, 4, 4.5});
  EXPECT_EQ(apart->area, 1.0);
  EXPECT_FALSE(apart->interval || apart->bootstrap);
  EXPECT_NE(apart.note.find("do not overlap"), std::string::npos);
  const auto few = roc_area(Values{1, 3, 5}, Values{2, 4, 6});
  EXPECT_TRUE(few->interval && !few->bootstrap);
  EXPECT_NE(few.note.find("the bootstrap needs 5"), std::string::npos);
  const auto equal = roc_area(Values{2, 2, 2}, Values{2, 2});
  EXPECT_EQ(equal->area, 0.5);
  EXPECT_FALSE(equal->interval);
}

TEST(RocArea, AGroupWithLowerValuesIsCutFromAbove) {
  const auto roc = roc_area(Values{1, 2, 3, 4, 5}, Values{4, 6, 7, 8, 9});
  EXPECT_LT(roc->area, 0.5);
  EXPECT_FALSE(roc->cut.at_least);
  // At or under 5: all of the group, and one of five others.
  EXPECT_EQ(roc->cut.threshold, 5.0);
  EXPECT_DOUBLE_EQ(roc->cut.sensitivity, 1.0);
  EXPECT_DOUBLE_EQ(roc->cut.specificity, 0.8);
}

}  // namespace
}  // namespace ream::statistics
