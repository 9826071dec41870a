#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "score/rubric.hpp"

namespace ream::score {

struct CriterionScore {
  Criterion criterion;
  std::optional<double> value, points;  ///< empty: it is missing
  std::optional<Verdict> verdict;       ///< empty: missing, or without limits
  std::string missing_reason;           ///< why there is no value; empty where there is one
};

enum class Outcome {
  pass,
  fail,
  undecided  ///< too little was measured
};

struct Score {
  /// Weighted mean of the criteria that have points, rounded down to a tenth: what is shown anywhere. Empty
  /// where none has, or where too little was measured.
  std::optional<double> points;
  double measured_percent = 0.0;  ///< share of all weights that the points rest on
  /// Fail where a critical criterion fails or points are short of the mark; undecided where a critical
  /// criterion is missing, or too much is; empty when the rubric has neither mark nor critical criteria.
  std::optional<Outcome> outcome;
  std::vector<std::string> reasons;  ///< of the outcome, one line each for people
  std::vector<CriterionScore> criteria;
};

/// `metrics` as metrics.json has them. Error invalid_input when the rubric names a metric that there is not.
Score apply_rubric(const Rubric& rubric, const nlohmann::json& metrics);

/// Points of a value, 0 to 100.
double points_of(const Criterion& criterion, double value);

/// Rubric by name, version and hash, points, outcome, reasons, criteria.
nlohmann::json score_json(const Rubric& rubric, const Score& score);

/// "pass", "fail", "undecided".
std::string_view to_text(Outcome outcome);

}  // namespace ream::score
