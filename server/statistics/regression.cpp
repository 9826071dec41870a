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

}  // namespace ream::statistics
