#include "statistics/rank_test.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "statistics/distributions.hpp"
#include "statistics/sample.hpp"

namespace ream::statistics {
namespace {

/// Sum of t^3 - t over groups of t equal values.
double tie_sum(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0.0;
  for (size_t first = 0; first < values.size();) {
    size_t end = first + 1;
    while (end < values.size() && values[end] == values[first]) ++end;
    const double t = static_cast<double>(end - first);
    sum += t * t * t - t;
    first = end;
  }
  return sum;
}

/// Chances of U = 0 to m n where all orders are as likely. Values are taken in rising order; the j-th of the
/// first group is larger than those of the second that came before it.
std::vector<double> chances_of_u(size_t m, size_t n) {
  std::vector<std::vector<double>> ways(m + 1, std::vector<double>(m * n + 1, 0.0));
  ways[0][0] = 1.0;
  for (size_t place = 1; place <= m + n; ++place)
    for (size_t j = std::min(place, m); j >= 1; --j) {
      const size_t larger_than = place - j;
      if (larger_than > n) continue;
      for (size_t u = 0; u + larger_than <= m * n; ++u) ways[j][u + larger_than] += ways[j - 1][u];
    }
  std::vector<double> chances = ways[m];
  const double all = std::accumulate(chances.begin(), chances.end(), 0.0);
  for (double& chance : chances) chance /= all;
  return chances;
}

double exact_p(double u, size_t m, size_t n) {
  const std::vector<double> chances = chances_of_u(m, n);
  const auto at = static_cast<long>(std::lround(std::min(u, static_cast<double>(m * n) - u)));
  return std::min(1.0, 2.0 * std::accumulate(chances.begin(), chances.begin() + at + 1, 0.0));
}

}  // namespace

Answer<MannWhitneyTest> mann_whitney_test(std::span<const double> first, std::span<const double> second) {
  if (first.empty() || second.empty())
    return {std::nullopt, "the Mann-Whitney test needs a value or more in each group"};
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  const std::vector<double> ranks = ranks_of(all);
  const double m = static_cast<double>(first.size()), n = static_cast<double>(second.size());
  const double of_first =
      std::accumulate(ranks.begin(), ranks.begin() + static_cast<long>(first.size()), 0.0);
  MannWhitneyTest test;
  test.u = of_first - 0.5 * m * (m + 1.0);
  const double ties = tie_sum(all), count = m + n;
  test.exact = ties == 0.0 && first.size() < exact_ranks_below && second.size() < exact_ranks_below;
  if (test.exact) {
    test.p = exact_p(test.u, first.size(), second.size());
    return {test, ""};
  }
  const double variance = m * n / 12.0 * (count + 1.0 - ties / (count * (count - 1.0)));
  if (!(variance > 0.0)) return {std::nullopt, "all values are equal, so that ranks say nothing"};
  const double away = std::abs(test.u - 0.5 * m * n);
  test.p = std::min(1.0, two_sided_normal_p(std::max(0.0, away - 0.5) / std::sqrt(variance)));
  return {test, ""};
}

}  // namespace ream::statistics
