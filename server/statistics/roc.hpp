#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// The cut that tells two groups apart best by Youden's J = sensitivity + specificity - 1 (Youden 1950). Of
/// cuts that are equally good, the lowest.
struct BestCut {
  double threshold = 0.0;  ///< an observed value
  bool at_least = true;    ///< of the group are said to be values at or over it; else at or under it
  double youden_j = 0.0;
  double sensitivity = 0.0, specificity = 0.0;
  Interval sensitivity_interval, specificity_interval;  ///< Wilson
};

/// How well a value tells a group from others.
struct RocArea {
  size_t group = 0, others = 0;
  /// Chance that a value of the group is over one of the others, ties half (Mann & Whitney). Below 0.5 the
  /// group has the lower values.
  double area = 0.0;
  std::optional<double> standard_error;  ///< DeLong
  std::optional<Interval> interval;      ///< area +- z error, cut off at 0 and 1
  std::optional<Interval> bootstrap;
  BestCut cut;
};

struct Bootstrap {
  uint64_t seed = 1;
  size_t samples = 2000;
  size_t least_group = 5;  ///< smaller groups get no interval by it
};

/// Interval by DeLong, DeLong & Clarke-Pearson 1988, "Comparing the areas under two or more correlated
/// receiver operating characteristic curves", Biometrics 44; and by the percentiles (R's type 7) of samples
/// that are drawn with replacement from each group for itself (Efron & Tibshirani 1993, chapter 13). Equal
/// seeds give equal bits. Needs two values or more in each group.
Answer<RocArea> roc_area(std::span<const double> group, std::span<const double> others,
                         const Bootstrap& bootstrap = {}, double confidence = 0.95);

}  // namespace ream::statistics
