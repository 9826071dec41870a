#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "score/rubric_score.hpp"

namespace ream::score {

/// What a trainee's failures are tested against. Rates between 0 and 1; the defaults suit a training session,
/// 5/15 % and 10/20 % suit a programme.
struct CusumParameters {
  double acceptable_rate = 0.20;    ///< p0: failures of somebody who is proficient
  double unacceptable_rate = 0.40;  ///< p1: failures of somebody who is not
  double alpha = 0.10;              ///< chance that the proficient are told they are not
  double beta = 0.10;               ///< chance that the others are told they are proficient
};

/// Steps and limits of the sum.
struct CusumLimits {
  double success_step = 0.0;       ///< -s
  double failure_step = 0.0;       ///< 1 - s
  double proficient_at = 0.0;      ///< h0, below 0: at or under it
  double not_proficient_at = 0.0;  ///< h1, above 0: at or over it
};

enum class Standing { going_on, proficient, not_proficient };

struct CusumPoint {
  bool success = false;
  double sum = 0.0;                        ///< after this session
  Standing decided = Standing::going_on;   ///< by this session; the sum then begins at 0 again
  Standing standing = Standing::going_on;  ///< the last decision, if there was one
};

/// Error invalid_input unless 0 < p0 < p1 < 1 and alpha, beta lie between 0 and 0.5.
CusumLimits cusum_limits(const CusumParameters& parameters);

/// Wald's sequential test over sessions in order: P = ln(p1/p0), Q = ln((1-p0)/(1-p1)), s = Q/(P+Q).
std::vector<CusumPoint> cusum(const CusumParameters& parameters, const std::vector<bool>& successes);

/// "going on", "proficient", "not proficient".
std::string_view to_text(Standing standing);

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
