#include "study/feel_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/json.hpp"
#include "statistics/mean_tests.hpp"
#include "statistics/proportion.hpp"
#include "statistics/sample.hpp"
#include "study/validity_report.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

constexpr double chance = 0.5;

/// Strelzow, Kusins, Ferreira & LeBel 2023: nine experts told cartilage, and its change to bone, by
/// vibration.
std::optional<PublishedShare> published_share(const std::string& comparison) {
  constexpr const char* source = "Strelzow et al. 2023, JBJS Open Access (PMC10292736), nine surgeons";
  if (comparison == "cartilage") return PublishedShare{0.69, 0.21, source};
  if (comparison == "bone_under_cartilage") return PublishedShare{0.77, 0.23, source};
  return std::nullopt;
}

/// A trial with the answer that was given; trials that are not answered are left out.
struct Answered {
  FeelTrial trial;
  const store::FeelAnswerRow* answer;

  bool right() const { return answer->chosen == trial.right_answer(); }
};

std::vector<Answered> answered_by(const Study& study, const std::string& code,
                                  const std::vector<store::FeelAnswerRow>& answers) {
  std::vector<Answered> answered;
  const std::vector<FeelTrial> trials = trials_for(*study.settings.feel, study.allocation_seed, code);
  for (const store::FeelAnswerRow& answer : answers)
    if (answer.participant == code && answer.trial >= 1 &&
        answer.trial <= static_cast<int64_t>(trials.size()))
      answered.push_back({trials[static_cast<size_t>(answer.trial - 1)], &answer});
  return answered;
}

/// Where all persons have the same share there is no t test: of answers as if they were one person's.
void add_exact_figures(FeelLine& line, size_t persons, size_t right) {
  line.interval = statistics::clopper_pearson_interval(right, line.answers);
  line.note =
      "all persons have the same share, so that the interval is that of Clopper and Pearson over all "
      "answers, and p that of a sign test over persons";
  if (*line.right == chance) return;
  line.chance_p = statistics::binomial_test(*line.right > chance ? persons : 0, persons)->p_two_sided;
}

void add_figures(FeelLine& line, const std::vector<double>& shares) {
  if (shares.size() < min_persons) {
    line.note = "persons who have answered all trials: " + std::to_string(shares.size()) + "; at least " +
                std::to_string(min_persons) + " are needed";
    return;
  }
  const auto mean = statistics::mean_estimate(shares);
  line.right = mean->mean;
  line.sd = mean->sd;
  const double answers = static_cast<double>(line.answers);
  const std::vector<double> guessed(shares.size(), chance);
  if (const auto test = statistics::paired_test(guessed, shares)) {
    line.chance_p = test->p;
    line.interval =
        statistics::Interval{std::max(0.0, mean->interval->low), std::min(1.0, mean->interval->high)};
  } else {
    add_exact_figures(line, shares.size(), static_cast<size_t>(std::lround(mean->mean * answers)));
  }
  // Half an answer short of all or none, where the formula has no value (Macmillan & Kaplan 1985).
  const double half = 0.5 / answers;
  line.d_prime = statistics::d_prime_of_share(std::clamp(mean->mean, half, 1.0 - half));
}

/// For the comparisons of one study, as one looks at all of them (Holm 1979).
void add_holm(std::vector<FeelLine>& lines) {
  std::vector<double> p_values;
  for (const FeelLine& line : lines)
    if (line.chance_p) p_values.push_back(*line.chance_p);
  const std::vector<double> adjusted = statistics::adjusted_by_holm(p_values);
  size_t next = 0;
  for (FeelLine& line : lines)
    if (line.chance_p) line.chance_p_holm = adjusted[next++];
}

json line_json(const FeelLine& line) {
  const auto bound = [&](double statistics::Interval::*end) {
    return line.interval ? json((*line.interval).*end) : json(nullptr);
  };
  json published;
  if (line.published)
    published = {
        {"share", line.published->share}, {"sd", line.published->sd}, {"source", line.published->source}};
  return {{"comparison", line.comparison->id},
          {"question", line.comparison->question},
          {"persons", line.persons},
          {"answers", line.answers},
          {"right", or_null(line.right)},
          {"sd", or_null(line.sd)},
          {"low", bound(&statistics::Interval::low)},
          {"high", bound(&statistics::Interval::high)},
          {"chance_p", or_null(line.chance_p)},
          {"chance_p_holm", or_null(line.chance_p_holm)},
          {"d_prime", or_null(line.d_prime)},
          {"note", line.note},
          {"published", std::move(published)}};
}

}  // namespace

FeelReport feel_report(const Study& study, const std::vector<Participant>& participants,
                       const std::vector<store::FeelAnswerRow>& answers) {
  const FeelTrials& settings = *study.settings.feel;
  std::map<std::string, std::vector<double>> shares;
  FeelReport report;
  for (const Participant& participant : participants) {
    std::map<std::string, std::pair<int, int>> right_of_all;
    for (const Answered& one : answered_by(study, participant.code, answers)) {
      auto& [right, all] = right_of_all[one.trial.comparison->id];
      right += one.right() ? 1 : 0;
      ++all;
    }
    report.participants += right_of_all.empty() ? 0 : 1;
    for (const auto& [comparison, counts] : right_of_all)
      if (counts.second == settings.trials_per_comparison)
        shares[comparison].push_back(static_cast<double>(counts.first) / counts.second);
  }
  for (const std::string& id : settings.comparisons) {
    FeelLine line;
    line.comparison = case_::find_plate_comparison(id);
    line.persons = shares[id].size();
    line.answers = line.persons * static_cast<size_t>(settings.trials_per_comparison);
    line.published = published_share(id);
    add_figures(line, shares[id]);
    report.lines.push_back(std::move(line));
  }
  add_holm(report.lines);
  return report;
}

json to_json(const FeelReport& report) {
  json lines = json::array();
  for (const FeelLine& line : report.lines) lines.push_back(line_json(line));
  return {{"lines", std::move(lines)}, {"participants", report.participants}};
}

session::ExportTable feel_answer_table(const Study& study, const std::vector<Participant>& participants,
                                       const std::vector<store::FeelAnswerRow>& answers) {
  session::ExportTable table;
  table.name = "answers";
  table.columns = {{"participant", "", "Code"},
                   {"experience", "", "novice, intermediate or expert"},
                   {"procedures_done", "", "As the participant said"},
                   {"trial", "", "From 1, in the participant's order"},
                   {"comparison", "", "What was asked"},
                   {"right_answer", "", "upper or lower plate"},
                   {"chosen", "", "upper or lower plate"},
                   {"right", "", "1: the two are equal"},
                   {"session", "", "In which the plates were felt"},
                   {"answered_utc", "", ""}};
  for (const Participant& participant : participants)
    for (const Answered& one : answered_by(study, participant.code, answers))
      table.rows.push_back({participant.code, participant.experience, participant.procedures_done,
                            one.trial.number, one.trial.comparison->id, one.trial.right_answer(),
                            one.answer->chosen, one.right() ? 1 : 0, one.answer->session,
                            one.answer->answered_utc});
  return table;
}

}  // namespace ream::study
