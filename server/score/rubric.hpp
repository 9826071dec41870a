#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ream::score {

/// One line of a rubric: points rise linearly from 0 where the metric is at `none` to 100 at `full`, and stay
/// there beyond both. Either may be the larger.
struct Criterion {
  std::string metric;  ///< a key of metrics.json whose value is a number
  double none = 0.0, full = 1.0;
  double weight = 1.0;
};

/// How metrics become points; a file of proto/rubric.schema.json.
struct Rubric {
  std::string name;
  int version = 1;
  std::vector<Criterion> criteria;
};

struct CriterionScore {
  std::string metric;
  std::optional<double> value, points;  ///< empty: the session does not say it
  double weight = 1.0;
};

struct Score {
  std::optional<double> points;  ///< weighted mean of the criteria that have points; empty when none has
  std::vector<CriterionScore> criteria;
};

/// Error not_found, invalid_input (names file and key).
Rubric load_rubric(const std::filesystem::path& path);
/// `metrics` as metrics_json gives them. Error invalid_input when the rubric names a metric that there is
/// not.
Score apply_rubric(const Rubric& rubric, const nlohmann::json& metrics);
nlohmann::json to_json(const Rubric& rubric, const Score& score);

}  // namespace ream::score
