#pragma once
#include <span>

namespace ream::statistics {

/// Least squares of y on x, and how sure one may be of it.
struct Regression {
  double slope = 0.0, intercept = 0.0;
  double rho = 0.0;  ///< Pearson's correlation
  double r_squared = 0.0;
  double p = 1.0;  ///< two-sided, of rho being 0
};

/// Needs as many x as y, at least three, and neither all equal.
Regression regression(std::span<const double> x, std::span<const double> y);

}  // namespace ream::statistics
