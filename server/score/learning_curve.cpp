#include "score/learning_curve.hpp"

#include <nlohmann/json.hpp>

namespace ream::score {
namespace {

using nlohmann::json;

bool is_decided(const LearningPoint& point) {
  return point.outcome == Outcome::pass || point.outcome == Outcome::fail;
}

json or_null(const std::optional<double>& number) { return number ? json(*number) : json(); }

}  // namespace

Standing LearningCurve::standing() const {
  Standing last = Standing::going_on;
  for (const LearningPoint& point : points)
    if (point.cusum) last = point.cusum->standing;
  return last;
}

int LearningCurve::passes_to_go() const {
  const CusumLimits limits = cusum_limits(parameters);
  double sum = 0.0;
  for (const LearningPoint& point : points)
    if (point.cusum) sum = point.cusum->decided == Standing::going_on ? point.cusum->sum : 0.0;
  int passes = 0;
  while (sum > limits.proficient_at) {
    sum += limits.success_step;
    ++passes;
  }
  return passes;
}

LearningCurve learning_curve(const CusumParameters& parameters, std::vector<LearningPoint> points) {
  std::vector<bool> successes;
  for (const LearningPoint& point : points)
    if (is_decided(point)) successes.push_back(point.outcome == Outcome::pass);
  const std::vector<CusumPoint> sums = cusum(parameters, successes);
  size_t next = 0;
  for (LearningPoint& point : points)
    point.cusum = is_decided(point) ? std::optional(sums[next++]) : std::nullopt;
  return {parameters, std::move(points)};
}

json learning_json(const LearningCurve& curve) {
  const CusumLimits limits = cusum_limits(curve.parameters);
  json points = json::array();
  for (const LearningPoint& point : curve.points) {
    json entry = {{"session", point.session},
                  {"created_utc", point.created_utc},
                  {"theatre", point.theatre},
                  {"points", or_null(point.points)},
                  {"outcome", point.outcome ? json(to_text(*point.outcome)) : json()},
                  {"cusum", point.cusum ? json(point.cusum->sum) : json()}};
    if (point.cusum) entry["standing"] = to_text(point.cusum->standing);
    points.push_back(std::move(entry));
  }
  return {{"standing", to_text(curve.standing())},
          {"passes_to_go", curve.passes_to_go()},
          {"acceptable_rate", curve.parameters.acceptable_rate},
          {"unacceptable_rate", curve.parameters.unacceptable_rate},
          {"alpha", curve.parameters.alpha},
          {"beta", curve.parameters.beta},
          {"proficient_at", limits.proficient_at},
          {"not_proficient_at", limits.not_proficient_at},
          {"sessions", std::move(points)}};
}

}  // namespace ream::score
