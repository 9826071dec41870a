#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// 0 of none. Of equal values it is that value, without rounding.
double mean_of(std::span<const double> values);

/// Mean and standard deviation (n - 1) of at least two values. Of equal values the deviation is 0, without
/// rounding.
struct Spread {
  double mean = 0.0, sd = 0.0;
};
Spread spread_of(std::span<const double> values);

/// Whether no value differs from the first; true of none.
bool all_equal(std::span<const double> values);

/// Of at least one value; the middle between the two middle ones of an even number.
double median_of(std::span<const double> values);

/// The quantile `share` (0 to 1) of sorted values, linear between neighbours (R's type 7). Not of none.
double quantile(const std::vector<double>& sorted, double share);

/// Ranks from 1, in the order of the values; equal values share the mean of their ranks.
std::vector<double> ranks_of(std::span<const double> values);

/// p values as they are judged when there are several of them, each at most 1 (Holm 1979, "A simple
/// sequentially rejective multiple test procedure"). In the order given.
std::vector<double> adjusted_by_holm(std::span<const double> p_values);

/// A mean with its t interval: mean +- t(n - 1) sd / sqrt(n). Equal values have none.
struct MeanEstimate {
  size_t n = 0;
  double mean = 0.0;
  std::optional<double> sd;          ///< empty for one value
  std::optional<Interval> interval;  ///< empty for one value, and where all are equal
};
Answer<MeanEstimate> mean_estimate(std::span<const double> values, double confidence = 0.95);

/// A median with the shortest symmetric pair of order statistics that holds it with at least the confidence
/// (Conover, Practical Nonparametric Statistics, 3.2): x(k) to x(n + 1 - k), k the largest for which a
/// binomial (n, 1/2) stays below k with a chance of at most half of what the confidence leaves out. Six
/// values or more have one at 95 %.
struct MedianEstimate {
  size_t n = 0;
  double median = 0.0;
  std::optional<Interval> interval;
  double coverage = 0.0;  ///< the confidence that this interval really has; 0 without one
};
Answer<MedianEstimate> median_estimate(std::span<const double> values, double confidence = 0.95);

}  // namespace ream::statistics
