#include "statistics/regression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/distributions.hpp"
#include "statistics/sample.hpp"

namespace ream::statistics {

Regression regression(std::span<const double> x, std::span<const double> y) {
  const double mx = mean_of(x), my = mean_of(y);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    xy += (x[i] - mx) * (y[i] - my);
    yy += (y[i] - my) * (y[i] - my);
  }
  Regression r;
  r.slope = xy / xx;
  r.intercept = my - r.slope * mx;
  r.rho = std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
  r.r_squared = r.rho * r.rho;
  const double freedom = static_cast<double>(x.size()) - 2.0;
  const double t = r.r_squared < 1.0 ? r.rho * std::sqrt(freedom / (1.0 - r.r_squared))
                                     : std::numeric_limits<double>::infinity();
  r.p = two_sided_t_p(t, freedom);
  return r;
}

Prediction prediction_95(std::span<const double> x, std::span<const double> y, double at) {
  const Regression r = regression(x, y);
  const double mx = mean_of(x), n = static_cast<double>(x.size());
  double left = 0.0, xx = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double off = y[i] - (r.slope * x[i] + r.intercept);
    left += off * off;
    xx += (x[i] - mx) * (x[i] - mx);
  }
  const double deviation_of_one = std::sqrt(left / (n - 2.0) * (1.0 + 1.0 / n + (at - mx) * (at - mx) / xx));
  const double reach = t_quantile(0.975, n - 2.0) * deviation_of_one;
  const double middle = r.slope * at + r.intercept;
  return {middle - reach, middle, middle + reach};
}

}  // namespace ream::statistics
