#include "statistics/mean_tests.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "statistics/distributions.hpp"
#include "statistics/sample.hpp"

namespace ream::statistics {
namespace {

/// Of the largest value: gains that differ by less differ by rounding, of values to 12 digits, too.
constexpr double rounding_of_gains = 1e-10;

MeanDifference tested(double difference, double error, double freedom, double tail) {
  const double reach = t_quantile(1.0 - tail, freedom) * error;
  const double t = difference / error;
  return {difference, t, freedom, two_sided_t_p(t, freedom), {difference - reach, difference + reach}};
}

/// After less before. Where they differ by rounding only, all are as the first.
std::vector<double> gains_of(std::span<const double> before, std::span<const double> after) {
  if (before.size() != after.size())
    throw Error(ErrorKind::invalid_input, "a change needs as many values before as after");
  std::vector<double> gains;
  double largest = 0.0;
  for (size_t i = 0; i < before.size(); ++i) {
    gains.push_back(after[i] - before[i]);
    largest = std::max({largest, std::abs(before[i]), std::abs(after[i])});
  }
  if (gains.empty()) return gains;
  const auto [least, most] = std::minmax_element(gains.begin(), gains.end());
  if (*most - *least <= rounding_of_gains * largest) std::fill(gains.begin(), gains.end(), gains.front());
  return gains;
}

/// Sums of squares and products around an arm's means.
struct ArmSums {
  double n = 0.0, before = 0.0, after = 0.0;  ///< number, means
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

ArmSums sums_of(const ArmValues& arm) {
  ArmSums sums{static_cast<double>(arm.before.size()), mean_of(arm.before), mean_of(arm.after)};
  for (size_t i = 0; i < arm.before.size(); ++i) {
    const double x = arm.before[i] - sums.before, y = arm.after[i] - sums.after;
    sums.xx += x * x;
    sums.xy += x * y;
    sums.yy += y * y;
  }
  return sums;
}

}  // namespace

Answer<MeanDifference> welch_test(std::span<const double> first, std::span<const double> second,
                                  double confidence) {
  const double tail = tail_of(confidence);
  if (first.size() < 2 || second.size() < 2)
    return {std::nullopt, "Welch's test needs two values or more in each group"};
  const Spread a = spread_of(first), b = spread_of(second);
  const double n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
  const double va = a.sd * a.sd / n1, vb = b.sd * b.sd / n2;
  if (!(va + vb > 0.0))
    return {std::nullopt, "the values of each group are equal, so that a test has no measure"};
  const double freedom = (va + vb) * (va + vb) / (va * va / (n1 - 1.0) + vb * vb / (n2 - 1.0));
  return {tested(a.mean - b.mean, std::sqrt(va + vb), freedom, tail), ""};
}

Answer<MeanDifference> paired_test(std::span<const double> before, std::span<const double> after,
                                   double confidence) {
  const double tail = tail_of(confidence);
  const std::vector<double> gains = gains_of(before, after);
  if (gains.size() < 2) return {std::nullopt, "a paired test needs two pairs or more"};
  const Spread spread = spread_of(gains);
  if (!(spread.sd > 0.0)) return {std::nullopt, "all changes are equal, so that a test has no measure"};
  const double n = static_cast<double>(gains.size());
  return {tested(spread.mean, spread.sd / std::sqrt(n), n - 1.0, tail), ""};
}

Answer<MeanDifference> difference_in_change(const ArmValues& first, const ArmValues& second,
                                            double confidence) {
  return welch_test(gains_of(first.before, first.after), gains_of(second.before, second.after), confidence);
}

Answer<MeanDifference> covariance_adjusted(const ArmValues& first, const ArmValues& second,
                                           double confidence) {
  const double tail = tail_of(confidence);
  if (first.before.size() != first.after.size() || second.before.size() != second.after.size())
    throw Error(ErrorKind::invalid_input, "a change needs as many values before as after");
  const ArmSums a = sums_of(first), b = sums_of(second);
  const double freedom = a.n + b.n - 3.0, xx = a.xx + b.xx;
  if (a.n < 2.0 || b.n < 2.0 || freedom < 1.0)
    return {std::nullopt, "an analysis of covariance needs two values or more in each arm, and four in all"};
  if (!(xx > 0.0))
    return {std::nullopt, "the values before are equal within each arm, so that they explain nothing"};
  const double slope = (a.xy + b.xy) / xx, apart = a.before - b.before;
  const double left = a.yy + b.yy - slope * (a.xy + b.xy);
  if (!(left > 1e-12 * (a.yy + b.yy)))
    return {std::nullopt, "the values after follow wholly from those before, so that a test has no measure"};
  const double error = std::sqrt(left / freedom * (1.0 / a.n + 1.0 / b.n + apart * apart / xx));
  return {tested(a.after - b.after - slope * apart, error, freedom, tail), ""};
}

}  // namespace ream::statistics
