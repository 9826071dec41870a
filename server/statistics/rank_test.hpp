#pragma once
#include <span>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// Whether one group's values tend to be larger (Mann & Whitney 1947).
struct MannWhitneyTest {
  double u = 0.0;      ///< pairs in which the first group's value is larger, ties half
  double p = 1.0;      ///< two-sided: twice the smaller tail, at most 1
  bool exact = false;  ///< by counting all orders; else normal, corrected for ties and continuity
};

/// Groups this large, or with ties, are judged by the normal distribution.
inline constexpr size_t exact_ranks_below = 50;

/// Needs a value or more in each group, and not all equal. The normal form with tie correction: Lehmann,
/// Nonparametrics, section 1.4.
Answer<MannWhitneyTest> mann_whitney_test(std::span<const double> first, std::span<const double> second);

}  // namespace ream::statistics
