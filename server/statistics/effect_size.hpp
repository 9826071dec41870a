#pragma once
#include <optional>
#include <span>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// Difference of two means in standard deviations (of both groups, pooled). Cohen's d, and Hedges' g, which
/// takes d's bias away: g = J d with J = Gamma(f / 2) / (sqrt(f / 2) Gamma((f - 1) / 2)), f = n1 + n2 - 2
/// (Hedges 1981). Intervals by the non-central t (Steiger & Fouladi 1997); g's is d's times J.
struct StandardizedDifference {
  double cohens_d = 0.0, hedges_g = 0.0;  ///< over 0 where the first group's mean is larger
  std::optional<Interval> d_interval, g_interval;
};

/// Needs two values or more in each group that are not all equal within both. Without intervals where t is
/// over 37, beyond which the non-central t is not exact enough.
Answer<StandardizedDifference> standardized_difference(std::span<const double> first,
                                                       std::span<const double> second,
                                                       double confidence = 0.95);

/// Share of pairs in which the first group's value is larger, less that in which it is smaller: -1 to 1
/// (Cliff 1993). The interval is that of DeLong for the ROC area, delta = 2 area - 1.
struct CliffsDelta {
  double delta = 0.0;
  std::optional<Interval> interval;
};
Answer<CliffsDelta> cliffs_delta(std::span<const double> first, std::span<const double> second,
                                 double confidence = 0.95);

}  // namespace ream::statistics
