#include <cmath>

#include "report/metric_tables.hpp"
#include "report/number_text.hpp"
#include "report/report.hpp"
#include "report/session_charts.hpp"

namespace ream::report {
namespace {

using score::Outcome;

std::string verdict_of(const std::optional<Outcome>& outcome) {
  if (!outcome) return "Not judged";
  if (*outcome == Outcome::undecided) return "Not assessed";
  return *outcome == Outcome::pass ? "Passed" : "Failed";
}

/// Points that rest on little say so.
std::string points_in_words(const score::Score& score) {
  if (!score.points) return "";
  const std::string points = decimal(*score.points, 1) + " of 100 points";
  if (score.measured_percent >= 99.95) return points;
  return points + ", on " + decimal(std::floor(score.measured_percent), 0) + "\u00a0% of the rubric";
}

void add(std::vector<Fact>& facts, const std::string& name, const std::string& value) {
  if (!value.empty()) facts.push_back({name, value});
}

std::vector<Fact> facts_of(const Material& m) {
  const SessionFacts& s = m.session;
  std::vector<Fact> facts;
  add(facts, s.blinded ? "Participant" : "Trainee", s.trainee.empty() ? "not named" : s.trainee);
  add(facts, "Date", s.created_utc.empty() ? "not known" : date_text(s.created_utc));
  if (s.attempt > 0) add(facts, "Attempt", std::to_string(s.attempt));
  add(facts, "Case", s.case_name);
  add(facts, "Side", s.side.empty() ? "not known" : s.side + " shoulder");
  add(facts, "Plan", m.plan_words);
  add(facts, "Reamer", s.reamer);
  add(facts, "Guide", s.guide);
  // A hand without limits of its own is that of a page or a script.
  const bool limited = !s.device_profile.empty() && s.device_profile != "ideal";
  add(facts, "Input device", s.device + (limited ? ", with the limits of " + s.device_profile : ""));
  add(facts, "Force scale",
      s.force_scale == 1.0 ? "1: the hand feels simulated newtons"
                           : shortest(s.force_scale) + " simulated N for 1 N at the hand");
  add(facts, "Theatre mode", s.theatre ? "on" : "off");
  if (!s.state.empty() && s.state != "finished")
    add(facts, "Ended", s.state + (s.fault.empty() ? "" : ": " + s.fault));
  return facts;
}

std::vector<Fact> provenance_of(const Material& m) {
  const SessionFacts& s = m.session;
  std::vector<Fact> facts;
  add(facts, "Session", s.id);
  add(facts, "Recorded by", s.build);
  add(facts, "Scored by", s.scored_by);
  add(facts, "Feed model", s.feed_model);
  add(facts, "Session hash", s.session_hash);
  add(facts, "Bone before", s.start_grid_hash);
  add(facts, "Bone after", s.grid_hash);
  add(facts, "Case hash", s.case_hash);
  return facts;
}

std::string learning_words(const score::LearningCurve& curve) {
  if (curve.points.empty()) return "";
  if (curve.points.size() == 1) return "This is the trainee's first session that counts.";
  const auto percent = [](double share) { return shortest(100.0 * share) + "\u00a0%"; };
  std::string words = "After " + std::to_string(curve.points.size()) +
                      " sessions: " + std::string(score::to_text(curve.standing())) + ". ";
  if (curve.standing() != score::Standing::proficient)
    words += "Passing the next " + std::to_string(curve.passes_to_go()) + " would show proficiency. ";
  return words + "CUSUM tests whether failures are as rare as " + percent(curve.parameters.acceptable_rate) +
         " rather than " + percent(curve.parameters.unacceptable_rate) + " (alpha " +
         percent(curve.parameters.alpha) + ", beta " + percent(curve.parameters.beta) +
         "); each decision begins a new sum.";
}

void put_benchmark(const Material& m, Report& report) {
  if (!m.benchmark) return;
  int reached = 0;
  for (const score::BenchmarkResult& result : score::compare_with(*m.benchmark, m.metrics)) {
    const score::Metric* metric = score::find_metric(result.line->metric);
    const std::string_view unit = metric ? metric->unit : std::string_view();
    const std::string name = metric ? std::string(metric->name) : result.line->metric;
    reached += result.reached ? 1 : 0;
    const std::string value = result.value ? with_unit(*result.value, unit) : "not available";
    report.benchmark.push_back(
        {name, value + (result.reached ? ", reached (" : ", not reached (") +
                   (result.line->better == score::Better::less ? "at most " : "at least ") +
                   with_unit(result.line->mean, unit) + ")"});
  }
  report.benchmark_words = "Benchmark \u201c" + m.benchmark->name + "\u201d: " + std::to_string(reached) +
                           " of " + std::to_string(report.benchmark.size()) + " reached.";
}

}  // namespace

Report make_report(const Material& m) {
  Report report;
  report.title = "Glenoid reaming";
  report.subtitle = m.session.case_name;
  report.created_utc = m.session.created_utc;
  report.facts = facts_of(m);
  report.outcome = m.score.outcome;
  report.verdict = verdict_of(m.score.outcome);
  report.points = points_in_words(m.score);
  report.judged_by = "Rubric \u201c" + m.rubric.name + "\u201d, version " + std::to_string(m.rubric.version) +
                     "; theatre mode " + (m.session.theatre ? "on" : "off");
  report.reasons = m.score.reasons;
  report.advice = advice_of(score::score_json(m.rubric, m.score), m.metrics);
  report.pictures = m.pictures;
  report.why_no_pictures = m.why_no_pictures;
  for (const Picture& picture : m.pictures) report.has_maps = report.has_maps || picture.is_map;
  report.tables = metric_tables(m, report.sources);
  report.missing = missing_metrics(m.metrics);
  report.meanings = metric_meanings(report.sources);
  if (m.trace && !m.trace->bins().empty())
    report.charts = session_charts(*m.trace, m.planned_depth_mm, m.remarks);
  else
    report.why_no_charts = "The session ended before its first moment was recorded.";
  report.remarks = m.remarks;
  if (m.load) report.load = load_section(*m.load);
  report.learning_charts = learning_charts(m.learning, m.rubric.pass_points);
  report.learning_words = learning_words(m.learning);
  put_benchmark(m, report);
  report.provenance = provenance_of(m);
  return report;
}

std::string mark_word(Mark mark) {
  switch (mark) {
    case Mark::pass: return "pass";
    case Mark::warn: return "warn";
    case Mark::fail: return "fail";
    case Mark::missing: return "not available";
    default: return "";
  }
}

std::string mark_sign(Mark mark) {
  switch (mark) {
    case Mark::pass: return "\u2713";
    case Mark::warn: return "!";
    case Mark::fail: return "\u2717";
    case Mark::missing: return "\u2013";
    default: return "";
  }
}

}  // namespace ream::report
