#pragma once
#include <span>

namespace ream::bench {

double mean(std::span<const double> values);
/// Of a sample (divided by n - 1); 0 for fewer than two values.
double deviation(std::span<const double> values);

/// Least squares of y on x, and how sure one may be of it.
struct Regression {
  double slope = 0.0, intercept = 0.0;
  double rho = 0.0;  ///< Pearson's correlation
  double r_squared = 0.0;
  double p = 1.0;  ///< two-sided, of rho being 0
};

/// Needs as many x as y, at least three, and neither all equal.
Regression regression(std::span<const double> x, std::span<const double> y);

/// Chance that Student's t with `freedom` degrees is farther from 0 than `t` (two-sided); exact sums of
/// Abramowitz & Stegun 26.7.3 and 26.7.4.
double two_sided_p(double t, int freedom);

/// The t that is exceeded on either side with chance `p`, above 0 and below 1.
double two_sided_t(double p, int freedom);

struct Interval {
  double low = 0.0, middle = 0.0, high = 0.0;
};

/// 95 % prediction interval of one new y at `at` by the regression of y on x: of many such experiments, 95 %
/// hold the next y. Needs at least three points.
Interval prediction_95(std::span<const double> x, std::span<const double> y, double at);

}  // namespace ream::bench
