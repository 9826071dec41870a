#include "score/cusum.hpp"

#include <cmath>

#include "core/error.hpp"

namespace ream::score {

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
    case Standing::proficient:
      return "proficient";
    case Standing::not_proficient:
      return "not proficient";
    default:
      return "going on";
  }
}

}  // namespace ream::score
