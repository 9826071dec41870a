#include "bench/validate/statistics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "bench/validate/published.hpp"
#include "core/units.hpp"

namespace ream::bench {
namespace {

TEST(Statistics, MeanAndDeviationOfASample) {
  // Squares about 5: 9 + 1 + 1 + 1 + 0 + 0 + 4 + 16 = 32.
  const std::array values{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  EXPECT_DOUBLE_EQ(mean(values), 5.0);
  EXPECT_DOUBLE_EQ(deviation(values), std::sqrt(32.0 / 7.0));
  EXPECT_EQ(deviation(std::array{3.0}), 0.0);
}

TEST(Statistics, RegressionWorkedByHand) {
  // x about 2: -1 0 1; y about 2: -1 1 0. Sxx 2, Syy 2, Sxy 1: slope 1/2, rho 1/2.
  const Regression r = regression(std::array{1.0, 2.0, 3.0}, std::array{1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(r.slope, 0.5);
  EXPECT_DOUBLE_EQ(r.intercept, 1.0);
  EXPECT_DOUBLE_EQ(r.rho, 0.5);
  EXPECT_DOUBLE_EQ(r.r_squared, 0.25);
  // One degree of freedom is Cauchy's: t = 0.5 / sqrt(0.75) = 1/sqrt(3) = tan(30 deg), so p = 1 - 2 * 30/180.
  EXPECT_NEAR(r.p, 2.0 / 3.0, 1e-12);
}

TEST(Statistics, AStraightLineLeavesNoDoubt) {
  const Regression r = regression(std::array{0.0, 1.0, 2.0, 4.0}, std::array{1.0, -1.0, -3.0, -7.0});
  EXPECT_DOUBLE_EQ(r.slope, -2.0);
  EXPECT_DOUBLE_EQ(r.rho, -1.0);
  EXPECT_NEAR(r.p, 0.0, 1e-12);
}

TEST(Statistics, StudentsTMatchesItsClosedFormsAndTables) {
  EXPECT_DOUBLE_EQ(two_sided_p(0.0, 5), 1.0);
  EXPECT_NEAR(two_sided_p(1.0, 1), 0.5, 1e-12);
  // Two degrees: inside share t / sqrt(2 + t^2).
  EXPECT_NEAR(two_sided_p(-1.5, 2), 1.0 - 1.5 / std::sqrt(4.25), 1e-12);
  // Printed tables: the two-sided 5 % points.
  const std::array<double, 6> five_percent{12.706, 4.303, 3.182, 2.776, 2.571, 2.447};
  for (size_t i = 0; i < five_percent.size(); ++i)
    EXPECT_NEAR(two_sided_p(five_percent[i], static_cast<int>(i) + 1), 0.05, 5e-5) << i + 1;
  EXPECT_EQ(two_sided_p(std::numeric_limits<double>::infinity(), 4), 0.0);
}

TEST(Statistics, TheThesisTableGivesThePublishedCorrelations) {
  for (const PublishedBone* bone : {&published_cortical, &published_cancellous}) {
    std::array<double, 6> density, feed;
    for (size_t i = 0; i < 6; ++i) {
      density[i] = bone->specimens[i].density_g_cc;
      feed[i] = bone->specimens[i].feed_mm_s;
    }
    const Regression r = regression(density, feed);
    EXPECT_NEAR(r.rho, bone->rho, 5e-5) << bone->name;
    EXPECT_NEAR(r.r_squared, bone->r_squared, 5e-4) << bone->name;
    EXPECT_NEAR(r.p, bone->p, 5e-5) << bone->name;
    EXPECT_NEAR(r.slope, bone->law.slope_mm_s_per_g_cc, 0.005) << bone->name;
    EXPECT_NEAR(r.intercept, bone->law.intercept_mm_s, 0.005) << bone->name;
  }
}

TEST(PublishedBone, SpecimenFactorsAreThoseOfTheTable) {
  const std::array cortical{1.088, 1.061, 0.712, 0.950, 0.839, 0.867};
  const std::array cancellous{1.073, 0.998, 0.913, 0.974, 1.099, 0.974};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(specimen_factor(published_cortical, published_cortical.specimens[i]), cortical[i], 6e-4);
    EXPECT_NEAR(specimen_factor(published_cancellous, published_cancellous.specimens[i]), cancellous[i],
                6e-4);
  }
}

TEST(Statistics, QuantilesOfStudentsTAreThoseOfTables) {
  EXPECT_NEAR(two_sided_t(0.05, 3), 3.182446, 1e-6);
  EXPECT_NEAR(two_sided_t(0.05, 4), 2.776445, 1e-6);
  EXPECT_NEAR(two_sided_t(0.01, 10), 3.169273, 1e-6);
}

TEST(Statistics, APredictionIntervalIsThatOfTheTextbook) {
  // Five points about y = x: residuals 0, 0.1, -0.2, 0.1, 0 (sums 0 and 0 with x), so s^2 = 0.06 / 3.
  const std::array<double, 5> x{1, 2, 3, 4, 5}, y{1.0, 2.1, 2.8, 4.1, 5.0};
  const Interval at = prediction_95(x, y, 5.0);
  EXPECT_NEAR(at.middle, 5.0, 1e-12);
  const double reach = 3.182446 * std::sqrt(0.02 * (1.0 + 0.2 + 0.4));
  EXPECT_NEAR(at.high - at.middle, reach, 1e-6);
  EXPECT_NEAR(at.middle - at.low, reach, 1e-6);
}

}  // namespace
}  // namespace ream::bench
