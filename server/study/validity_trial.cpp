#include <set>

#include "statistics/mean_tests.hpp"
#include "study/validity_data.hpp"
#include "study/validity_sections.hpp"

namespace ream::study {
namespace {

using statistics::ArmValues;

const std::vector<std::string> later_phases = {"post", "retention"};

std::set<std::string> arms_of(const std::vector<RatedSession>& sessions) {
  std::set<std::string> arms;
  for (const RatedSession& session : sessions)
    if (!session.arm.empty()) arms.insert(session.arm);
  return arms;
}

bool has_phase(const std::vector<RatedSession>& sessions, const std::string& phase) {
  for (const RatedSession& session : sessions)
    if (session.phase == phase && !session.arm.empty()) return true;
  return false;
}

/// Values of an arm's participants who have both, in the order of their codes.
ArmValues arm_values(const std::vector<RatedSession>& sessions, const std::string& arm,
                     const std::string& phase, const std::string& measure) {
  const auto means_in = [&](const std::string& wanted) {
    return person_means(sessions, [&](const RatedSession& session) {
      return session.arm == arm && session.phase == wanted ? measure_in(session, measure) : std::nullopt;
    });
  };
  const auto before = means_in("pre"), after = means_in(phase);
  ArmValues values;
  for (const auto& [person, value] : before)
    if (const auto later = after.find(person); later != after.end()) {
      values.before.push_back(value);
      values.after.push_back(later->second);
    }
  return values;
}

std::string too_few_pairs(const std::string& arm, size_t found) {
  return std::to_string(found) + " participants of arm '" + arm +
         "' with a value before and after; at least " + std::to_string(min_persons) + " are needed";
}

ValidityLine change_line(const std::string& arm, const std::string& phase, const std::string& measure,
                         const ArmValues& values) {
  ValidityLine line{arm + ":" + phase, measure, {}, {}};
  add_value(line, "n", static_cast<double>(values.before.size()));
  if (values.before.size() < min_persons) {
    add_note(line, too_few_pairs(arm, values.before.size()));
    return line;
  }
  const auto change = statistics::paired_test(values.before, values.after);
  add_note(line, change.note);
  if (!change) return line;
  add_estimate(line, "change", change->difference, change->interval);
  add_value(line, "paired_p", change->p);
  return line;
}

ValidityLine difference_line(const std::string& phase, const std::string& measure, const std::string& first,
                             const ArmValues& of_first, const std::string& second,
                             const ArmValues& of_second) {
  ValidityLine line{first + "-" + second + ":" + phase, measure, {}, {}};
  add_value(line, "n_first", static_cast<double>(of_first.before.size()));
  add_value(line, "n_second", static_cast<double>(of_second.before.size()));
  if (of_first.before.size() < min_persons) add_note(line, too_few_pairs(first, of_first.before.size()));
  if (of_second.before.size() < min_persons) add_note(line, too_few_pairs(second, of_second.before.size()));
  if (!line.notes.empty()) return line;
  const auto change = statistics::difference_in_change(of_first, of_second);
  add_note(line, change.note);
  if (change) {
    add_estimate(line, "difference", change->difference, change->interval);
    add_value(line, "welch_p", change->p);
  }
  const auto adjusted = statistics::covariance_adjusted(of_first, of_second);
  add_note(line, adjusted.note);
  if (adjusted) {
    add_estimate(line, "ancova", adjusted->difference, adjusted->interval);
    add_value(line, "ancova_p", adjusted->p);
  }
  return line;
}

void append(std::vector<ValidityLine>& all, std::vector<ValidityLine> some) {
  for (ValidityLine& line : some) all.push_back(std::move(line));
}

}  // namespace

std::vector<ValidityLine> change_lines(const std::vector<RatedSession>& sessions) {
  std::vector<ValidityLine> all;
  for (const std::string& arm : arms_of(sessions))
    for (const std::string& phase : later_phases) {
      if (!has_phase(sessions, phase)) continue;
      std::vector<ValidityLine> lines;
      for (const std::string& measure : measures_of(sessions))
        lines.push_back(change_line(arm, phase, measure, arm_values(sessions, arm, phase, measure)));
      add_holm(lines, "paired_p");
      append(all, std::move(lines));
    }
  return all;
}

std::vector<ValidityLine> arm_difference_lines(const std::vector<RatedSession>& sessions) {
  const std::set<std::string> arms = arms_of(sessions);
  std::vector<ValidityLine> all;
  for (auto first = arms.begin(); first != arms.end(); ++first)
    for (auto second = std::next(first); second != arms.end(); ++second)
      for (const std::string& phase : later_phases) {
        if (!has_phase(sessions, phase)) continue;
        std::vector<ValidityLine> lines;
        for (const std::string& measure : measures_of(sessions))
          lines.push_back(difference_line(phase, measure, *first,
                                          arm_values(sessions, *first, phase, measure), *second,
                                          arm_values(sessions, *second, phase, measure)));
        add_holm(lines, "welch_p");
        add_holm(lines, "ancova_p");
        append(all, std::move(lines));
      }
  return all;
}

}  // namespace ream::study
