#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "score/rubric.hpp"

namespace ream::score {

struct CriterionScore {
  Criterion criterion;
  std::optional<double> value, points;  ///< empty: the session does not say it
  std::optional<Verdict> verdict;       ///< empty: not said, or without limits
  std::string unsaid;                   ///< why there is no value; empty where there is one
};

enum class Outcome {
  pass,
  fail,
  undecided  ///< the session says too little
};

struct Score {
  std::optional<double> points;  ///< weighted mean of the criteria that have points; empty when none has
  double said_percent = 0.0;     ///< share of all weights that the points rest on
  /// Fail where a critical criterion fails or points are short of the mark; undecided where a critical
  /// criterion is not said, or too little is; empty when the rubric has neither mark nor critical criteria.
  std::optional<Outcome> outcome;
  std::vector<std::string> reasons;  ///< of the outcome, one line each for people
  std::vector<CriterionScore> criteria;
};

/// `metrics` as metrics.json has them. Error invalid_input when the rubric names a metric that there is not.
Score apply_rubric(const Rubric& rubric, const nlohmann::json& metrics);

/// Why a metric has no number; empty for one that nobody knows.
std::string why_unsaid(const nlohmann::json& metrics, const std::string& metric);

/// Points of a value, 0 to 100.
double points_of(const Criterion& criterion, double value);

/// Rubric by name, version and hash, points, outcome, reasons, criteria.
nlohmann::json score_json(const Rubric& rubric, const Score& score);

/// "pass", "fail", "undecided".
std::string_view to_text(Outcome outcome);

}  // namespace ream::score
