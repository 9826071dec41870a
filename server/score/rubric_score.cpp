#include "score/rubric_score.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "score/metric_results.hpp"

namespace ream::score {
namespace {

using nlohmann::json;

constexpr double points_outside_between = 50.0;

double points_by(const Ramp& ramp, double value) {
  return 100.0 * std::clamp((value - ramp.none) / (ramp.full - ramp.none), 0.0, 1.0);
}

double points_by(const std::vector<CurvePoint>& curve, double value) {
  if (value <= curve.front().at) return curve.front().points;
  for (size_t i = 1; i < curve.size(); ++i) {
    const CurvePoint &low = curve[i - 1], &high = curve[i];
    if (value <= high.at)
      return low.points + (high.points - low.points) * (value - low.at) / (high.at - low.at);
  }
  return curve.back().points;
}

double points_by(const Band& band, double value) {
  const std::optional<Verdict> judged = verdict(band, value);
  if (judged == Verdict::pass) return 100.0;
  if (judged == Verdict::fail) return 0.0;
  if (band.better == Better::between || band.warn == band.pass) return points_outside_between;
  return points_by(Ramp{band.warn, band.pass}, value);
}

std::string name_of(const std::string& metric) {
  const Metric* known = find_metric(metric);
  return known ? std::string(known->name) : metric;
}

std::string in_words(double points) { return json(rounded_points(points)).dump(); }

CriterionScore scored(const Rubric& rubric, const Criterion& criterion, const json& metrics) {
  CriterionScore result;
  result.criterion = criterion;
  const auto found = metrics.find(criterion.metric);
  if (found == metrics.end() || !found->is_number()) {
    result.missing_reason = missing_reason(metrics, criterion.metric);
    if (!result.missing_reason.empty()) return result;
    throw Error(ErrorKind::invalid_input, "rubric '" + rubric.name + "': there is no metric '" +
                                              criterion.metric + "' with a number; metrics.json names them");
  }
  result.value = found->get<double>();
  result.points = points_of(criterion, *result.value);
  result.verdict = verdict(criterion.judged_by(), *result.value);
  return result;
}

/// What decides by criteria that are critical; empty when nothing does.
std::optional<Outcome> critical_outcome(Score& score) {
  std::optional<Outcome> outcome;
  for (const CriterionScore& c : score.criteria) {
    if (!c.criterion.critical) continue;
    if (c.verdict == Verdict::fail) {
      outcome = Outcome::fail;
      score.reasons.push_back(name_of(c.criterion.metric) + " failed; it is a critical criterion");
    } else if (!c.value) {
      if (outcome != Outcome::fail) outcome = Outcome::undecided;
      score.reasons.push_back(name_of(c.criterion.metric) +
                              " is a critical criterion and could not be assessed: " + c.missing_reason);
    }
  }
  return outcome;
}

/// What decides by points.
Outcome points_outcome(const Rubric& rubric, Score& score) {
  if (!score.points) {
    score.reasons.push_back("only " + in_words(score.measured_percent) +
                            " % of the criteria, by weight, could be assessed; " +
                            in_words(rubric.min_measured_percent) + " % are needed");
    return Outcome::undecided;
  }
  const bool passed = *score.points >= rounded_points(*rubric.pass_points);
  score.reasons.push_back(in_words(*score.points) + " of 100 points; the pass mark is " +
                          in_words(*rubric.pass_points));
  return passed ? Outcome::pass : Outcome::fail;
}

std::optional<Outcome> outcome_of(const Rubric& rubric, Score& score) {
  const bool any_critical = std::any_of(rubric.criteria.begin(), rubric.criteria.end(),
                                        [](const Criterion& c) { return c.critical; });
  if (!rubric.pass_points && !any_critical) return std::nullopt;
  const std::optional<Outcome> by_critical = critical_outcome(score);
  std::optional<Outcome> by_points;
  if (rubric.pass_points) by_points = points_outcome(rubric, score);
  for (const Outcome worst : {Outcome::fail, Outcome::undecided})
    if (by_critical == worst || by_points == worst) return worst;
  return Outcome::pass;
}

}  // namespace

double points_of(const Criterion& criterion, double value) {
  if (!criterion.curve.empty()) return points_by(criterion.curve, value);
  return criterion.ramp ? points_by(*criterion.ramp, value) : points_by(criterion.judged_by(), value);
}

Score apply_rubric(const Rubric& rubric, const json& metrics) {
  Score score;
  double sum = 0.0, measured = 0.0, all = 0.0;
  for (const Criterion& c : rubric.criteria) {
    score.criteria.push_back(scored(rubric, c, metrics));
    all += c.weight;
    if (const auto& points = score.criteria.back().points) {
      sum += c.weight * *points;
      measured += c.weight;
    }
  }
  if (all > 0.0) score.measured_percent = 100.0 * measured / all;
  if (measured > 0.0 && score.measured_percent >= rubric.min_measured_percent)
    score.points = rounded_points(sum / measured);
  score.outcome = outcome_of(rubric, score);
  return score;
}

json score_json(const Rubric& rubric, const Score& score) {
  json criteria = json::array();
  for (const CriterionScore& c : score.criteria) {
    json line = {{"metric", c.criterion.metric},
                 {"value", or_null(c.value)},
                 {"points", or_null(c.points)},
                 {"weight", c.criterion.weight},
                 {"critical", c.criterion.critical},
                 {"band", band_json(c.criterion.judged_by())},
                 {"verdict", c.verdict ? json(to_text(*c.verdict)) : json()}};
    // "unsaid" is the key of the version before.
    if (!c.missing_reason.empty()) line["missing"] = line["unsaid"] = c.missing_reason;
    criteria.push_back(std::move(line));
  }
  return {{"rubric", rubric.name},
          {"version", rubric.version},
          {"hash", to_hex(rubric_hash(rubric))},
          {"points", or_null(score.points)},
          {"said_percent", score.measured_percent},
          {"outcome", score.outcome ? json(to_text(*score.outcome)) : json()},
          {"reasons", score.reasons},
          {"criteria", std::move(criteria)}};
}

std::string_view to_text(Outcome outcome) {
  constexpr std::string_view texts[] = {"pass", "fail", "undecided"};
  return texts[static_cast<size_t>(outcome)];
}

}  // namespace ream::score
