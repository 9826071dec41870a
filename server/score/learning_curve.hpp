#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "score/cusum.hpp"
#include "score/rubric_score.hpp"

namespace ream::score {

/// One session of a trainee.
struct LearningPoint {
  std::string session, created_utc;
  bool theatre = false;
  std::optional<double> points;
  std::optional<Outcome> outcome;
  /// After this session; empty where it was neither passed nor failed, which CUSUM leaves out.
  std::optional<CusumPoint> cusum;
};

/// A trainee's sessions in order of time, judged by one rubric.
struct LearningCurve {
  CusumParameters parameters;
  std::vector<LearningPoint> points;

  Standing standing() const;
  /// How many more passed sessions in a row would prove proficiency, as the sum stands now.
  int passes_to_go() const;
};

/// Fills in each point's cusum. The order of `points` is kept. Error invalid_input as cusum_limits.
LearningCurve learning_curve(const CusumParameters& parameters, std::vector<LearningPoint> points);

nlohmann::json learning_json(const LearningCurve& curve);

}  // namespace ream::score
