#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// Agreement beyond chance of raters who sort subjects into categories.
struct Kappa {
  size_t subjects = 0;
  double kappa = 0.0;
  double observed = 0.0;  ///< share of agreement, weighted
  double expected = 0.0;  ///< that of chance
  std::optional<double> standard_error;
  std::optional<Interval> interval;  ///< cut off at -1 and 1
};

/// How much two categories apart count as agreement: none; 1 - d / (c - 1); 1 - (d / (c - 1))^2.
enum class KappaWeights { none, linear, quadratic };

/// Two raters. `table[i][j]` counts the subjects that the first put into category i and the second into j.
/// Cohen 1960 and 1968; the interval by the large-sample variance of Fleiss, Cohen & Everitt 1969, "Large
/// sample standard errors of kappa and weighted kappa", Psychol Bull 72, which holds where kappa is not 0.
Answer<Kappa> cohens_kappa(const std::vector<std::vector<size_t>>& table,
                           KappaWeights weights = KappaWeights::none, double confidence = 0.95);

/// Three raters or more, or two who are exchangeable. `counts[i][j]` says how many raters put subject i into
/// category j; as many in every row, two or more. Fleiss 1971, "Measuring nominal scale agreement among many
/// raters", Psychol Bull 76; the interval by Gwet 2021, "Large-sample variance of Fleiss generalized kappa",
/// Educ Psychol Meas 81 (over subjects, t with n - 1 degrees of freedom).
Answer<Kappa> fleiss_kappa(const std::vector<std::vector<size_t>>& counts, double confidence = 0.95);

}  // namespace ream::statistics
