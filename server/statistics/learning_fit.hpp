#pragma once
#include <cstddef>
#include <span>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// A learning curve: y = plateau + (start - plateau) exp(-rate (attempt - 1)). What is learned comes in equal
/// shares of what is left (Mazur & Hastie 1978; Heathcote, Brown & Mewhort 2000, "The power law repealed",
/// Psychon Bull Rev 7). Intervals are estimate +- t(n - 3) error, with errors of least squares at the fit
/// (Bates & Watts 1988, Nonlinear Regression Analysis, section 2.2).
struct LearningFit {
  size_t n = 0;
  double start = 0.0;             ///< at the first attempt, in the unit of y
  double plateau = 0.0;           ///< after many
  double rate = 0.0;              ///< share that an attempt takes off what is left, for small rates
  double residual_sd = 0.0;       ///< around the curve
  double attempts_to_half = 0.0;  ///< after the first, until half is learned: ln 2 / rate
  Interval start_interval, plateau_interval, rate_interval;
};

/// Rates that are looked for. Beyond them the data do not show a curve.
inline constexpr double min_learning_rate = 0.01, max_learning_rate = 5.0;

/// Attempts count from 1, and may repeat. Five values or more at four different attempts or more; as many
/// values as attempts. Without an answer when no rate within the limits fits best, or when the rate's
/// interval holds 0: what fits noise best is no curve.
Answer<LearningFit> learning_fit(std::span<const double> attempts, std::span<const double> values,
                                 double confidence = 0.95);

}  // namespace ream::statistics
