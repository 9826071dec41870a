#include "app/cli/print_score.hpp"

#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>

#include "report/advice.hpp"
#include "report/metric_tables.hpp"
#include "report/number_text.hpp"
#include "score/metric_catalogue.hpp"
#include "score/rubric_score.hpp"

namespace ream::app {
namespace {

using nlohmann::json;

constexpr int name_width = 30, value_width = 14;

std::string outcome_in_words(const json& outcome) {
  if (outcome.is_null()) return "not judged";
  if (outcome == "undecided") return "not assessed";
  return outcome == "pass" ? "passed" : "failed";
}

std::string points_in_words(const json& points) {
  return points.is_null()
             ? "no points"
             : report::decimal(score::rounded_points(points.get<double>()), 1) + " of 100 points";
}

/// "pass 100", as far as a rubric has something to say of it.
std::string verdict_in_words(const json& score, std::string_view metric) {
  for (const json& c : score.at("criteria"))
    if (c.at("metric") == metric && !c.at("value").is_null())
      return (c.at("verdict").is_null() ? std::string() : c.at("verdict").get<std::string>() + ", ") +
             (c.at("weight") == 0.0 ? "no weight"
                                    : report::decimal(c.at("points").get<double>(), 0) + " points") +
             (c.at("critical") == true ? ", critical" : "");
  return "";
}

void print_metrics(const json& metrics, const json& score) {
  for (const score::Metric& metric : score::metric_catalogue()) {
    const json value = metrics.value(std::string(metric.key), json());
    if (!value.is_number()) continue;
    std::string judged = verdict_in_words(score, metric.key);
    if (const auto verdict = score::verdict(metric.band, value.get<double>()); judged.empty() && verdict)
      judged = score::to_text(*verdict);
    std::cout << "  " << std::left << std::setw(name_width) << metric.name << std::setw(value_width)
              << report::with_unit(value.get<double>(), metric.unit) << "  " << judged << '\n';
  }
}

void print_missing(const json& metrics) {
  const std::vector<report::Fact> missing = report::missing_metrics(metrics);
  if (!missing.empty()) std::cout << "  not available:\n";
  for (const report::Fact& fact : missing)
    std::cout << "    " << fact.value << ":\n      " << fact.name << '\n';
}

}  // namespace

void print_score(const std::string& session, const json& document) {
  const json& score = document.at("score");
  std::cout << session << ": " << outcome_in_words(score.at("outcome")) << ", "
            << points_in_words(score.at("points")) << " (" << score.at("rubric").get<std::string>()
            << ", version " << score.at("version") << "; theatre mode "
            << (document.at("theatre") == true ? "on" : "off") << ")\n";
  for (const json& reason : score.at("reasons")) std::cout << "  " << reason.get<std::string>() << '\n';
  const std::vector<report::Advice> advice = report::advice_of(score, document.at("metrics"));
  if (!advice.empty()) std::cout << "  next time:\n";
  for (const report::Advice& each : advice) std::cout << "    " << each.words << '\n';
  if (const json own = document.value("plugin_score", json()); !own.is_null()) {
    std::cout << "  by " << own.at("plugin").at("name").get<std::string>() << ' '
              << own.at("plugin").at("version").get<std::string>() << ": "
              << outcome_in_words(own.at("outcome")) << ", " << points_in_words(own.at("points")) << '\n';
    for (const json& line : own.at("lines")) std::cout << "    " << line.get<std::string>() << '\n';
  }
  print_metrics(document.at("metrics"), score);
  print_missing(document.at("metrics"));
  if (const json& benchmark = document.at("benchmark"); !benchmark.is_null())
    std::cout << "  benchmark " << benchmark.at("benchmark").get<std::string>() << ": "
              << benchmark.at("reached") << " of " << benchmark.at("of") << " reached\n";
}

void print_learning(const std::string& trainee, const json& learning) {
  std::cout << trainee << " after " << learning.at("sessions").size()
            << " sessions: " << learning.at("standing").get<std::string>() << "; the next "
            << learning.at("passes_to_go") << " passed would show proficiency\n";
  for (const json& one : learning.at("sessions"))
    std::cout << "  " << one.at("session").get<std::string>() << "  "
              << one.at("created_utc").get<std::string>() << "  " << points_in_words(one.at("points")) << ", "
              << outcome_in_words(one.at("outcome")) << (one.at("theatre") == true ? ", theatre mode" : "")
              << (one.at("cusum").is_null() ? ""
                                            : ", sum " + report::decimal(one.at("cusum").get<double>(), 2))
              << '\n';
}

}  // namespace ream::app
