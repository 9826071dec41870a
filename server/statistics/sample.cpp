#include "statistics/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "statistics/distributions.hpp"

namespace ream::statistics {
namespace {

std::vector<double> sorted_copy(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// Indices of the values, the least value first.
std::vector<size_t> order_of(std::span<const double> values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

bool all_equal(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
}

double mean_of(std::span<const double> values) {
  if (values.empty()) return 0.0;
  if (all_equal(values)) return values.front();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Spread spread_of(std::span<const double> values) {
  Spread result;
  result.mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.sd = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return result;
}

double median_of(std::span<const double> values) {
  const std::vector<double> sorted = sorted_copy(values);
  const size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(place);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::vector<double> ranks_of(std::span<const double> values) {
  const std::vector<size_t> order = order_of(values);
  std::vector<double> ranks(values.size());
  for (size_t first = 0; first < order.size();) {
    size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (size_t i = first; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(first + 1 + end);
    first = end;
  }
  return ranks;
}

std::vector<double> adjusted_by_holm(std::span<const double> p_values) {
  const std::vector<size_t> order = order_of(p_values);
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, static_cast<double>(order.size() - i) * p_values[order[i]]);
    adjusted[order[i]] = std::min(1.0, largest);
  }
  return adjusted;
}

Answer<MeanEstimate> mean_estimate(std::span<const double> values, double confidence) {
  const double tail = tail_of(confidence);
  if (values.empty()) return {std::nullopt, "no value"};
  MeanEstimate estimate;
  estimate.n = values.size();
  estimate.mean = mean_of(values);
  if (values.size() < 2) return {estimate, "one value has no interval"};
  const Spread spread = spread_of(values);
  const double n = static_cast<double>(values.size());
  const double reach = t_quantile(1.0 - tail, n - 1.0) * spread.sd / std::sqrt(n);
  estimate.sd = spread.sd;
  if (!(spread.sd > 0.0)) return {estimate, "all values are equal, so that their mean has no interval"};
  estimate.interval = Interval{estimate.mean - reach, estimate.mean + reach};
  return {estimate, ""};
}

Answer<MedianEstimate> median_estimate(std::span<const double> values, double confidence) {
  const double tail = tail_of(confidence);
  if (values.empty()) return {std::nullopt, "no value"};
  const std::vector<double> sorted = sorted_copy(values);
  const size_t n = sorted.size();
  MedianEstimate estimate;
  estimate.n = n;
  estimate.median = median_of(values);
  size_t k = 0;
  while (2 * (k + 1) <= n && binomial_cdf(k, n, 0.5) <= tail) ++k;
  if (k == 0)
    return {estimate, "the median of " + std::to_string(n) + (n == 1 ? " value" : " values") +
                          " has no interval of this confidence (95 % need six)"};
  estimate.interval = Interval{sorted[k - 1], sorted[n - k]};
  estimate.coverage = 1.0 - 2.0 * binomial_cdf(k - 1, n, 0.5);
  return {estimate, ""};
}

}  // namespace ream::statistics
