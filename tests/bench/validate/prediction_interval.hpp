#pragma once
#include <cmath>
#include <span>

#include "statistics/distributions.hpp"
#include "statistics/regression.hpp"
#include "statistics/sample.hpp"

namespace ream::bench {

struct Prediction {
  double low = 0.0, middle = 0.0, high = 0.0;
};

/// 95 % prediction interval of one new y at `at` by the regression of y on x: of many such experiments, 95 %
/// hold the next y. Needs at least three points.
inline Prediction prediction_95(std::span<const double> x, std::span<const double> y, double at) {
  const statistics::Regression r = statistics::regression(x, y);
  const double mx = statistics::mean_of(x), n = static_cast<double>(x.size());
  double left = 0.0, xx = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double off = y[i] - (r.slope * x[i] + r.intercept);
    left += off * off;
    xx += (x[i] - mx) * (x[i] - mx);
  }
  const double deviation_of_one = std::sqrt(left / (n - 2.0) * (1.0 + 1.0 / n + (at - mx) * (at - mx) / xx));
  const double reach = statistics::t_quantile(0.975, n - 2.0) * deviation_of_one;
  const double middle = r.slope * at + r.intercept;
  return {middle - reach, middle, middle + reach};
}

}  // namespace ream::bench
