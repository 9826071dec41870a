#include "study/validity_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/validity_data.hpp"
#include "study/validity_sections.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

json line_json(const ValidityLine& line) {
  json values = json::object();
  for (const auto& [name, value] : line.values) values[name] = value;
  return {{"subject", line.subject},
          {"measure", line.measure},
          {"values", std::move(values)},
          {"notes", line.notes}};
}

/// Lines of measures that never come are left out, with one sentence for all of them.
std::vector<ValidityLine> or_sentence(bool wanted, std::vector<ValidityLine> lines, const char* why,
                                      ValidityReport& report) {
  if (wanted) return lines;
  report.notes.emplace_back(why);
  return {};
}

}  // namespace

ValidityReport validity_report(const ValidityInput& input) {
  check_validity_input(input);
  const std::vector<RatedSession> sessions = with_raters_total(input);
  const auto any = [&](const auto& has) { return std::any_of(sessions.begin(), sessions.end(), has); };
  const bool rated = any([](const RatedSession& s) { return s.measures.contains(raters_total); });
  const bool compared = any([](const RatedSession& s) { return s.experience == "expert"; });
  const bool trial = any([](const RatedSession& s) { return !s.arm.empty() && s.phase == "pre"; });
  const bool counted = any([](const RatedSession& s) { return s.attempt > 0; });
  ValidityReport report;
  report.agreement = agreement_lines(input);
  report.checklist = checklist_lines(input);
  report.known_groups = or_sentence(compared, known_group_lines(input, sessions),
                                    "no participant is an expert, so that groups are not compared", report);
  report.correlations = or_sentence(rated, correlation_lines(sessions),
                                    "no rater has rated a session on all scale items, so that measures are "
                                    "not compared with raters",
                                    report);
  report.changes =
      or_sentence(trial, change_lines(sessions),
                  "no session of an arm is of the phase pre, so that there are no changes", report);
  if (trial) report.arm_differences = arm_difference_lines(sessions);
  report.benchmarks = or_sentence(compared, benchmark_lines(sessions),
                                  "no participant is an expert, so that there is no benchmark", report);
  report.learning = or_sentence(counted, learning_lines(sessions),
                                "no session has an attempt, so that there is no learning curve", report);
  return report;
}

std::array<ValidityPart, 8> parts_of(const ValidityReport& report) {
  return {{{"agreement", &report.agreement},
           {"checklist", &report.checklist},
           {"known_groups", &report.known_groups},
           {"correlations", &report.correlations},
           {"changes", &report.changes},
           {"arm_differences", &report.arm_differences},
           {"benchmarks", &report.benchmarks},
           {"learning", &report.learning}}};
}

json validity_json(const ValidityReport& report) {
  json all = {{"notes", report.notes}};
  for (const auto& [name, lines] : parts_of(report)) {
    all[name] = json::array();
    for (const ValidityLine& line : *lines) all[name].push_back(line_json(line));
  }
  return all;
}

}  // namespace ream::study
