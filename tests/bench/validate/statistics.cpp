#include "bench/validate/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/units.hpp"

namespace ream::bench {

double mean(std::span<const double> values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const double m = mean(values);
  double squares = 0.0;
  for (const double v : values) squares += (v - m) * (v - m);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double two_sided_p(double t, int freedom) {
  if (std::isinf(t)) return 0.0;
  const double theta = std::atan(std::abs(t) / std::sqrt(static_cast<double>(freedom)));
  const double c = std::cos(theta), s = std::sin(theta);
  // Inside share: odd freedom sums odd powers of the cosine, even freedom even powers.
  const bool odd = freedom % 2 == 1;
  double term = odd ? c : 1.0, sum = freedom == 1 ? 0.0 : term;
  for (int k = odd ? 3 : 2; k <= freedom - 2; k += 2) {
    term *= c * c * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  const double inside = odd ? 2.0 / pi * (theta + s * sum) : s * sum;
  return std::clamp(1.0 - inside, 0.0, 1.0);
}

Regression regression(std::span<const double> x, std::span<const double> y) {
  const double mx = mean(x), my = mean(y);
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
  const int freedom = static_cast<int>(x.size()) - 2;
  r.p = two_sided_p(r.rho * std::sqrt(freedom / (1.0 - r.r_squared)), freedom);
  return r;
}

double two_sided_t(double p, int freedom) {
  double low = 0.0, high = 1.0;
  while (two_sided_p(high, freedom) > p) high *= 2.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (two_sided_p(middle, freedom) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Interval prediction_95(std::span<const double> x, std::span<const double> y, double at) {
  const Regression r = regression(x, y);
  const double mx = mean(x), n = static_cast<double>(x.size());
  double left = 0.0, xx = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double off = y[i] - (r.slope * x[i] + r.intercept);
    left += off * off;
    xx += (x[i] - mx) * (x[i] - mx);
  }
  const double deviation_of_one = std::sqrt(left / (n - 2.0) * (1.0 + 1.0 / n + (at - mx) * (at - mx) / xx));
  const double reach = two_sided_t(0.05, static_cast<int>(x.size()) - 2) * deviation_of_one;
  const double middle = r.slope * at + r.intercept;
  return {middle - reach, middle, middle + reach};
}

}  // namespace ream::bench
