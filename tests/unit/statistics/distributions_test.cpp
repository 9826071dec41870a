#include "statistics/distributions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/expect_error.hpp"

namespace ream::statistics {
namespace {

TEST(Distributions, StudentsTMatchesItsClosedFormsAndTables) {
  EXPECT_DOUBLE_EQ(two_sided_t_p(0.0, 5), 1.0);
  // One degree of freedom is Cauchy's, two have inside t / sqrt(2 + t^2).
  EXPECT_NEAR(two_sided_t_p(1.0, 1), 0.5, 1e-12);
  EXPECT_NEAR(two_sided_t_p(-1.5, 2), 1.0 - 1.5 / std::sqrt(4.25), 1e-12);
  const std::array<double, 6> five_percent{12.706, 4.303, 3.182, 2.776, 2.571, 2.447};
  for (size_t i = 0; i < five_percent.size(); ++i)
    EXPECT_NEAR(two_sided_t_p(five_percent[i], static_cast<double>(i + 1)), 0.05, 5e-5) << i + 1;
  EXPECT_EQ(two_sided_t_p(std::numeric_limits<double>::infinity(), 4), 0.0);
  EXPECT_NEAR(t_quantile(0.975, 3), 3.182446, 1e-6);
  EXPECT_NEAR(t_quantile(0.995, 10), 3.169273, 1e-6);
}

TEST(Distributions, OthersMatchTables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959964, 1e-6);
  EXPECT_NEAR(two_sided_normal_p(-1.959964), 0.05, 1e-7);
  EXPECT_NEAR(f_quantile(0.95, 5, 10), 3.3258, 1e-4);
  EXPECT_NEAR(f_quantile(0.975, 3, 15), 4.1528, 1e-4);
  // Beta (1, n) is one minus the n-th power.
  EXPECT_NEAR(beta_quantile(0.975, 1, 10), 1.0 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_NEAR(binomial_cdf(2, 5, 0.5), 16.0 / 32.0, 1e-12);
  EXPECT_NEAR(binomial_density(2, 5, 0.5), 10.0 / 32.0, 1e-12);
  EXPECT_NEAR(gamma_ratio(4.0, 1.0), 0.25, 1e-12);
}

/// Chance that (Z + shift) / sqrt(chi^2 / f) is at most t, by Simpson's rule over s = sqrt(chi^2 / f).
double noncentral_t_by_integration(double t, double f, double shift) {
  constexpr int steps = 20000;
  const double end = 1.0 + 12.0 / std::sqrt(f), width = end / steps;
  const double log_scale = 0.5 * f * std::log(f) - (0.5 * f - 1.0) * std::log(2.0) - std::lgamma(0.5 * f);
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double s = i * width;
    if (s <= 0.0) continue;
    const double density = std::exp(log_scale + (f - 1.0) * std::log(s) - 0.5 * f * s * s);
    const double below = 0.5 * std::erfc((shift - t * s) / std::sqrt(2.0));
    sum += density * below * (i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum * width / 3.0;
}

TEST(Distributions, TheNonCentralTIsItsIntegral) {
  for (const double f : {4.0, 18.0, 60.0})
    for (const double shift : {-3.0, 0.0, 0.7, 5.0, 20.0})
      for (const double t : {-2.0, 0.5, 4.0, 19.0})
        EXPECT_NEAR(noncentral_t_cdf(t, f, shift), noncentral_t_by_integration(t, f, shift), 1e-7)
            << f << " " << shift << " " << t;
}

TEST(Distributions, NoncentralityIsFoundAgain) {
  for (const double f : {2.0, 18.0, 200.0})
    for (const double t : {-30.0, -1.0, 0.0, 2.5, 12.0, 37.0})
      for (const double p : {0.025, 0.5, 0.975}) {
        const double shift = noncentrality_of_t(t, f, p);
        EXPECT_NEAR(noncentral_t_by_integration(t, f, shift), p, 1e-6) << f << " " << t << " " << p;
      }
}

TEST(Distributions, AConfidenceLiesBetween0And1) {
  EXPECT_NEAR(tail_of(0.95), 0.025, 1e-15);
  for (const double wrong : {0.0, 1.0, 95.0, std::nan("")})
    test::expect_error(ErrorKind::invalid_input, "confidence", [&] { tail_of(wrong); });
}

}  // namespace
}  // namespace ream::statistics
