#include "statistics/effect_size.hpp"

#include <cmath>

#include "statistics/distributions.hpp"
#include "statistics/roc.hpp"
#include "statistics/sample.hpp"

namespace ream::statistics {
namespace {

constexpr double largest_t = 37.0;

}  // namespace

Answer<StandardizedDifference> standardized_difference(std::span<const double> first,
                                                       std::span<const double> second, double confidence) {
  const double tail = tail_of(confidence);
  if (first.size() < 2 || second.size() < 2)
    return {std::nullopt, "an effect size needs two values or more in each group"};
  const Spread a = spread_of(first), b = spread_of(second);
  const double n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
  const double freedom = n1 + n2 - 2.0;
  const double pooled = std::sqrt(((n1 - 1.0) * a.sd * a.sd + (n2 - 1.0) * b.sd * b.sd) / freedom);
  if (!(pooled > 0.0))
    return {std::nullopt, "the values of each group are equal, so that an effect has no unit"};
  const double correction = gamma_ratio(0.5 * (freedom - 1.0), 0.5);
  // Gamma(x) / Gamma(x + 1/2) of x = (f - 1) / 2 is the inverse of what J needs.
  const double j = 1.0 / (correction * std::sqrt(0.5 * freedom));
  StandardizedDifference effect;
  effect.cohens_d = (a.mean - b.mean) / pooled;
  effect.hedges_g = j * effect.cohens_d;
  const double to_d = std::sqrt(1.0 / n1 + 1.0 / n2);
  const double t = effect.cohens_d / to_d;
  if (std::abs(t) > largest_t) return {effect, "the effect is too large for an interval"};
  effect.d_interval = Interval{to_d * noncentrality_of_t(t, freedom, 1.0 - tail),
                               to_d * noncentrality_of_t(t, freedom, tail)};
  effect.g_interval = Interval{j * effect.d_interval->low, j * effect.d_interval->high};
  return {effect, ""};
}

Answer<CliffsDelta> cliffs_delta(std::span<const double> first, std::span<const double> second,
                                 double confidence) {
  const Answer<RocArea> roc = roc_area(first, second, {.samples = 1}, confidence);
  if (!roc) return {std::nullopt, "Cliff's delta needs two values or more in each group"};
  CliffsDelta result{2.0 * roc->area - 1.0, std::nullopt};
  if (!roc->interval)
    return {result, "the groups do not overlap, or all values are equal, so that delta has no interval"};
  result.interval = Interval{2.0 * roc->interval->low - 1.0, 2.0 * roc->interval->high - 1.0};
  return {result, ""};
}

}  // namespace ream::statistics
