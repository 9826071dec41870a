#include "score/learning_curve.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::score {
using nlohmann::json;
namespace {

bool is_decided(const LearningPoint& point) {
  return point.outcome == Outcome::pass || point.outcome == Outcome::fail;
}

}  // namespace

CusumLimits cusum_limits(const CusumParameters& p) {
  const bool rates =
      p.acceptable_rate > 0.0 && p.acceptable_rate < p.unacceptable_rate && p.unacceptable_rate < 1.0;
  if (!rates)
    throw Error(
        ErrorKind::invalid_input,
        "CUSUM: the acceptable failure rate must be over 0 and below the unacceptable one, and that below 1");
  const auto risk = [](double value) { return value > 0.0 && value < 0.5; };
  if (!risk(p.alpha) || !risk(p.beta))
    throw Error(ErrorKind::invalid_input, "CUSUM: alpha and beta must lie between 0 and 0.5");
  const double up = std::log(p.unacceptable_rate / p.acceptable_rate);
  const double down = std::log((1.0 - p.acceptable_rate) / (1.0 - p.unacceptable_rate));
  const double s = down / (up + down);
  CusumLimits limits;
  limits.success_step = -s;
  limits.failure_step = 1.0 - s;
  limits.proficient_at = -std::log((1.0 - p.alpha) / p.beta) / (up + down);
  limits.not_proficient_at = std::log((1.0 - p.beta) / p.alpha) / (up + down);
  return limits;
}

std::vector<CusumPoint> cusum(const CusumParameters& parameters, const std::vector<bool>& successes) {
  const CusumLimits limits = cusum_limits(parameters);
  std::vector<CusumPoint> points;
  double sum = 0.0;
  Standing standing = Standing::going_on;
  for (const bool success : successes) {
    sum += success ? limits.success_step : limits.failure_step;
    CusumPoint point{success, sum, Standing::going_on, standing};
    if (sum <= limits.proficient_at) point.decided = Standing::proficient;
    if (sum >= limits.not_proficient_at) point.decided = Standing::not_proficient;
    if (point.decided != Standing::going_on) {
      point.standing = standing = point.decided;
      sum = 0.0;
    }
    points.push_back(point);
  }
  return points;
}

std::string_view to_text(Standing standing) {
  switch (standing) {
    case Standing::proficient: return "proficient";
    case Standing::not_proficient: return "not proficient";
    default: return "going on";
  }
}

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
