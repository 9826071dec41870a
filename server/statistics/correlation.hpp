#pragma once
#include <cstddef>
#include <optional>
#include <span>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// Pearson's r of pairs with Fisher's interval, tanh(atanh r +- z / sqrt(n - 3)) (Fisher 1921), and its p by
/// t = r sqrt((n - 2) / (1 - r^2)).
struct Correlation {
  size_t n = 0;
  double r = 0.0;
  double p = 1.0;                    ///< two-sided, of r being 0
  std::optional<Interval> interval;  ///< empty for three pairs, for |r| = 1, and of ranks
};

/// Needs as many x as y. Three pairs or more have an answer, four an interval.
Answer<Correlation> pearson(std::span<const double> x, std::span<const double> y, double confidence = 0.95);

/// Spearman's: Pearson's of ranks, ties with their mean rank, p by t as above. Without interval.
Answer<Correlation> spearman(std::span<const double> x, std::span<const double> y);

}  // namespace ream::statistics
