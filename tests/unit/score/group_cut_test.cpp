#include "score/group_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

using test::expect_error;
using Values = std::vector<double>;

/// Three values with exactly this mean and standard deviation.
Values group(double mean, double sd) { return {mean - sd, mean, mean + sd}; }

double normal(double x, double mean, double sd) {
  return std::exp(-0.5 * std::pow((x - mean) / sd, 2)) / (sd * std::sqrt(2.0 * std::numbers::pi));
}

TEST(GroupCut, EquallySpreadGroupsAreCutInTheMiddle) {
  const GroupCut cut = contrasting_groups(group(40.0, 10.0), group(70.0, 10.0), Density::normal);
  EXPECT_NEAR(cut.cut, 55.0, 1e-9);
  EXPECT_TRUE(cut.experts_higher);
  // Phi(-1.5), from tables.
  EXPECT_NEAR(cut.expected_novices_passing, 0.0668072, 1e-6);
  EXPECT_NEAR(cut.expected_experts_failing, 0.0668072, 1e-6);
  EXPECT_EQ(cut.novices_passing, 0);
  EXPECT_EQ(cut.experts_failing, 0);
}

/// Two normal densities are equal where a quadratic equation in x says so; its root between the means is the
/// cut.
TEST(GroupCut, UnequallySpreadGroupsAreCutAtTheRootOfTheQuadratic) {
  std::mt19937 random(test::seed(71));
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    const double m0 = 100.0 * uniform(random), s0 = 1.0 + 9.0 * uniform(random),
                 s1 = 1.0 + 9.0 * uniform(random);
    const double m1 = m0 + (uniform(random) < 0.5 ? -1.0 : 1.0) * (25.0 + 20.0 * uniform(random));
    const double a = 1.0 / (s0 * s0) - 1.0 / (s1 * s1);
    const double b = -2.0 * (m0 / (s0 * s0) - m1 / (s1 * s1));
    const double c = m0 * m0 / (s0 * s0) - m1 * m1 / (s1 * s1) + 2.0 * std::log(s0 / s1);
    const double root = std::sqrt(b * b - 4.0 * a * c);
    double expected = (-b + root) / (2.0 * a);
    if (expected < std::min(m0, m1) || expected > std::max(m0, m1)) expected = (-b - root) / (2.0 * a);
    const GroupCut cut = contrasting_groups(group(m0, s0), group(m1, s1), Density::normal);
    EXPECT_NEAR(cut.cut, expected, 1e-6) << "seed 71, round " << round;
    EXPECT_EQ(cut.experts_higher, m1 > m0);
  }
}

TEST(GroupCut, CountsWhoIsOnTheWrongSide) {
  const Values novices = {10, 20, 30, 80}, experts = {40, 90, 95, 100, 20};
  const GroupCut cut = contrasting_groups(novices, experts, Density::normal);
  EXPECT_EQ(cut.novices, 4);
  EXPECT_EQ(cut.experts, 5);
  EXPECT_EQ(cut.novices_passing, 1);
  EXPECT_EQ(cut.experts_failing, 2);
  // The same with less being better.
  const auto mirrored = [](Values values) {
    for (double& value : values) value = -value;
    return values;
  };
  const GroupCut below = contrasting_groups(mirrored(novices), mirrored(experts), Density::normal);
  EXPECT_FALSE(below.experts_higher);
  EXPECT_NEAR(below.cut, -cut.cut, 1e-9);
  EXPECT_EQ(below.novices_passing, 1);
  EXPECT_EQ(below.experts_failing, 2);
  EXPECT_NEAR(below.expected_novices_passing, cut.expected_novices_passing, 1e-9);
}

TEST(GroupCut, KernelCutOfMirrorImagesIsTheirMiddle) {
  const Values novices = {1.0, 2.0, 2.5, 3.0, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.6};
  Values experts;
  for (const double value : novices) experts.push_back(13.0 - value);
  const GroupCut cut = contrasting_groups(novices, experts, Density::kernel);
  EXPECT_NEAR(cut.cut, 6.5, 1e-9);
  EXPECT_EQ(cut.novices_passing, 1);
  EXPECT_EQ(cut.experts_failing, 1);
}

/// The densities written out for three values, whose quartiles are the middles of the gaps: sd = 10, IQR =
/// 10, bandwidth 0.9 (10 / 1.34) 3^(-1/5).
TEST(GroupCut, KernelDensitiesAreEqualAtTheCut) {
  const double width = 0.9 * (10.0 / 1.34) * std::pow(3.0, -0.2);
  const auto density = [&](double x, double mean, double sd) {
    const double w = width * sd / 10.0;
    return (normal(x, mean - sd, w) + normal(x, mean, w) + normal(x, mean + sd, w)) / 3.0;
  };
  const GroupCut cut = contrasting_groups(group(40.0, 10.0), group(75.0, 5.0), Density::kernel);
  EXPECT_NEAR(density(cut.cut, 40.0, 10.0), density(cut.cut, 75.0, 5.0), 1e-9);
  EXPECT_GT(cut.cut, 40.0);
  EXPECT_LT(cut.cut, 75.0);
}

TEST(GroupCut, BothDensitiesAgreeOnManyNormalValues) {
  std::mt19937 random(test::seed(72));
  std::normal_distribution<double> low(30.0, 9.0), high(76.0, 14.0);
  Values novices(4000), experts(4000);
  std::generate(novices.begin(), novices.end(), [&] { return low(random); });
  std::generate(experts.begin(), experts.end(), [&] { return high(random); });
  const double a = contrasting_groups(novices, experts, Density::normal).cut;
  const double b = contrasting_groups(novices, experts, Density::kernel).cut;
  EXPECT_NEAR(a, b, 1.0);
}

TEST(GroupCut, ExpectedSharesAreThoseOfManyDraws) {
  const GroupCut cut = contrasting_groups(group(30.0, 9.0), group(50.0, 14.0), Density::normal);
  std::mt19937 random(test::seed(73));
  std::normal_distribution<double> novice(30.0, 9.0), expert(50.0, 14.0);
  int passing = 0, failing = 0;
  constexpr int draws = 200000;
  for (int i = 0; i < draws; ++i) {
    passing += cut.passes(novice(random)) ? 1 : 0;
    failing += cut.passes(expert(random)) ? 0 : 1;
  }
  EXPECT_NEAR(cut.expected_novices_passing, static_cast<double>(passing) / draws, 0.004);
  EXPECT_NEAR(cut.expected_experts_failing, static_cast<double>(failing) / draws, 0.004);
}

TEST(GroupCut, GroupsThatCannotBeCutAreRefused) {
  const Values good = group(50.0, 5.0);
  expect_error(ErrorKind::invalid_input, "2 novices", [&] {
    contrasting_groups(Values{1, 2}, good, Density::normal);
  });
  expect_error(ErrorKind::invalid_input, "experts have the same value", [&] {
    contrasting_groups(good, Values{7, 7, 7}, Density::kernel);
  });
  expect_error(ErrorKind::invalid_input, "not finite", [&] {
    contrasting_groups(good, Values{7, NAN, 9}, Density::normal);
  });
  // A narrow group within a wide one: one density is above the other from mean to mean.
  expect_error(ErrorKind::invalid_input, "do not cross",
               [&] { contrasting_groups(group(50.0, 20.0), group(52.0, 1.0), Density::normal); });
  expect_error(ErrorKind::invalid_input, "do not cross",
               [&] { contrasting_groups(good, good, Density::normal); });
}

}  // namespace
}  // namespace ream::score
