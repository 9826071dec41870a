#include "study/validity_sections.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "statistics/correlation.hpp"
#include "statistics/effect_size.hpp"
#include "statistics/kappa.hpp"
#include "statistics/learning_fit.hpp"
#include "statistics/mean_tests.hpp"
#include "statistics/rank_test.hpp"
#include "statistics/roc.hpp"
#include "statistics/sample.hpp"
#include "study/validity_data.hpp"

namespace ream::study {
namespace {

using statistics::Answer;
using statistics::Interval;

double count_of(size_t number) { return static_cast<double>(number); }

std::vector<double> values_of(const std::map<std::string, double>& by_person) {
  std::vector<double> values;
  values.reserve(by_person.size());
  for (const auto& [person, value] : by_person) values.push_back(value);
  return values;
}

/// One value of each participant of this experience, in the order of their codes.
std::vector<double> group_values(const std::vector<RatedSession>& sessions, const std::string& experience,
                                 const std::string& measure) {
  return values_of(group_means(sessions, experience, measure));
}

/// With the rater who rated fewest, for one is enough to leave too few that all have rated.
std::string too_few_rated(const RatingTable& table, size_t found) {
  std::string fewest;
  size_t least = table.rows().size() + 1;
  for (size_t j = 0; j < table.raters(); ++j) {
    const auto rated = static_cast<size_t>(std::count_if(
        table.rows().begin(), table.rows().end(), [&](const auto& row) { return row[j].has_value(); }));
    if (rated < least) least = rated, fewest = table.rater(j);
  }
  std::string words = "sessions that all raters rated: " + std::to_string(found) + "; at least " +
                      std::to_string(min_persons) + " are needed";
  if (least < table.rows().size())
    words +=
        "; " + fewest + " rated only " + std::to_string(least) + " of " + std::to_string(table.rows().size());
  return words;
}

std::string too_few(const std::string& whom, size_t found) {
  return std::to_string(found) + " " + whom + " with a value; at least " + std::to_string(min_persons) +
         " are needed";
}

ValidityLine agreement_line(const std::string& measure, const RatingTable& table) {
  ValidityLine line{"", measure, {}, {}};
  const size_t complete = statistics::complete_rows(table.rows()).rows.size();
  add_value(line, "subjects", count_of(complete));
  add_value(line, "raters", count_of(table.raters()));
  add_value(line, "dropped", count_of(table.rows().size() - complete));
  if (table.raters() > 1 && complete < min_persons) {
    add_note(line, too_few_rated(table, complete));
    return line;
  }
  const auto icc = statistics::intraclass_correlation(table.rows());
  add_note(line, icc.note);
  if (!icc) return line;
  add_estimate(line, "icc_single", icc->single, icc->single_interval);
  add_estimate(line, "icc_average", icc->average, icc->average_interval);
  return line;
}

/// Items of which there is a rating.
std::set<std::string> rated_items(const ValidityInput& input) {
  std::set<std::string> items;
  for (const Rating& rating : input.ratings) items.insert(rating.item);
  return items;
}

Answer<statistics::Kappa> kappa_of(const std::vector<std::vector<double>>& rows, size_t raters) {
  std::vector<std::vector<size_t>> counts;
  if (raters == 2) {
    counts.assign(2, std::vector<size_t>(2, 0));
    for (const auto& row : rows) ++counts[row[0] > 0.5 ? 1 : 0][row[1] > 0.5 ? 1 : 0];
    return statistics::cohens_kappa(counts);
  }
  for (const auto& row : rows) {
    const auto yes = static_cast<size_t>(std::count(row.begin(), row.end(), 1.0));
    counts.push_back({row.size() - yes, yes});
  }
  return statistics::fleiss_kappa(counts);
}

/// Of two raters each, over all rows (of 0 and 1).
double share_of_equal_pairs(const std::vector<std::vector<double>>& rows) {
  double share = 0.0;
  for (const auto& row : rows) {
    const double raters = count_of(row.size());
    const double yes = static_cast<double>(std::count(row.begin(), row.end(), 1.0)), no = raters - yes;
    share += (yes * (yes - 1.0) + no * (no - 1.0)) / (raters * (raters - 1.0));
  }
  return share / count_of(rows.size());
}

ValidityLine checklist_line(const std::string& item, const RatingTable& table) {
  ValidityLine line{"", item, {}, {}};
  const statistics::CompleteRatings complete = statistics::complete_rows(table.rows());
  add_value(line, "subjects", count_of(complete.rows.size()));
  add_value(line, "raters", count_of(table.raters()));
  add_value(line, "dropped", count_of(complete.dropped));
  if (table.raters() < 2) {
    add_note(line, "agreement needs two raters or more");
    return line;
  }
  if (complete.rows.size() < min_persons) {
    add_note(line, too_few_rated(table, complete.rows.size()));
    return line;
  }
  add_value(line, "agreement", share_of_equal_pairs(complete.rows));
  const Answer<statistics::Kappa> kappa = kappa_of(complete.rows, table.raters());
  add_note(line, kappa.note);
  if (!kappa) return line;
  add_estimate(line, "kappa", kappa->kappa, kappa->interval);
  return line;
}

void add_group(ValidityLine& line, const std::string& group, const std::vector<double>& values) {
  add_value(line, "n_" + group, count_of(values.size()));
  if (values.size() < min_persons) {
    add_note(line, too_few(group, values.size()));
    return;
  }
  const statistics::Spread spread = statistics::spread_of(values);
  add_value(line, "mean_" + group, spread.mean);
  add_value(line, "sd_" + group, spread.sd);
}

void add_roc(ValidityLine& line, const Answer<statistics::RocArea>& roc) {
  add_note(line, roc.note);
  if (!roc) return;
  add_estimate(line, "auc", roc->area, roc->interval);
  add_interval(line, "auc_bootstrap", roc->bootstrap);
  const statistics::BestCut& cut = roc->cut;
  add_value(line, "threshold", cut.threshold);
  add_value(line, "experts_at_least", cut.at_least ? 1.0 : 0.0);
  add_value(line, "youden_j", cut.youden_j);
  add_estimate(line, "sensitivity", cut.sensitivity, cut.sensitivity_interval);
  add_estimate(line, "specificity", cut.specificity, cut.specificity_interval);
}

ValidityLine known_group_line(const std::string& measure, const std::vector<double>& experts,
                              const std::vector<double>& novices, const statistics::Bootstrap& bootstrap) {
  ValidityLine line{"", measure, {}, {}};
  add_group(line, "experts", experts);
  add_group(line, "novices", novices);
  if (experts.size() < min_persons || novices.size() < min_persons) return line;
  const auto welch = statistics::welch_test(experts, novices);
  add_note(line, welch.note);
  if (welch) {
    add_estimate(line, "difference", welch->difference, welch->interval);
    add_value(line, "welch_p", welch->p);
  }
  const auto ranks = statistics::mann_whitney_test(experts, novices);
  add_note(line, ranks.note);
  if (ranks) add_value(line, "mann_whitney_p", ranks->p);
  const auto effect = statistics::standardized_difference(experts, novices);
  add_note(line, effect.note);
  if (effect) {
    add_value(line, "cohens_d", effect->cohens_d);
    add_estimate(line, "hedges_g", effect->hedges_g, effect->g_interval);
  }
  if (const auto delta = statistics::cliffs_delta(experts, novices))
    add_value(line, "cliffs_delta", delta->delta);
  add_roc(line, statistics::roc_area(experts, novices, bootstrap));
  return line;
}

ValidityLine correlation_line(const std::vector<RatedSession>& sessions, const std::string& measure) {
  const auto mean_where_both = [&](const std::string& wanted) {
    return values_of(person_means(sessions, [&](const RatedSession& session) {
      const bool both = measure_in(session, measure) && measure_in(session, raters_total);
      return both ? measure_in(session, wanted) : std::nullopt;
    }));
  };
  const std::vector<double> values = mean_where_both(measure), totals = mean_where_both(raters_total);
  ValidityLine line{"", measure, {}, {}};
  add_value(line, "n", count_of(values.size()));
  const auto pearson = statistics::pearson(values, totals);
  add_note(line, pearson.note);
  if (!pearson) return line;
  add_estimate(line, "pearson", pearson->r, pearson->interval);
  add_value(line, "pearson_p", pearson->p);
  const auto spearman = statistics::spearman(values, totals);
  add_note(line, spearman.note);
  if (!spearman) return line;
  add_value(line, "spearman", spearman->r);
  add_value(line, "spearman_p", spearman->p);
  return line;
}

ValidityLine benchmark_line(const std::string& measure, const std::vector<double>& experts) {
  ValidityLine line{"", measure, {}, {}};
  add_value(line, "n", count_of(experts.size()));
  if (experts.size() < min_persons) {
    add_note(line, too_few("experts", experts.size()));
    return line;
  }
  const auto mean = statistics::mean_estimate(experts);
  add_note(line, mean.note);
  add_estimate(line, "mean", mean->mean, mean->interval);
  const auto median = statistics::median_estimate(experts);
  add_note(line, median.note);
  add_estimate(line, "median", median->median, median->interval);
  return line;
}

/// Whether a session shows how people learn: not an expert's, and no test.
bool shows_learning(const RatedSession& session) {
  static const std::set<std::string> tests = {"pre", "post", "retention"};
  return session.attempt > 0 && session.experience != "expert" && !tests.contains(session.phase);
}

ValidityLine learning_line(const std::vector<RatedSession>& sessions, const std::string& measure) {
  std::map<int, std::vector<double>> by_attempt;
  for (const RatedSession& session : sessions)
    if (const auto value = measure_in(session, measure); value && shows_learning(session))
      by_attempt[session.attempt].push_back(*value);
  std::vector<double> attempts, means;
  ValidityLine line{"", measure, {}, {}};
  for (const auto& [attempt, values] : by_attempt) {
    if (values.size() < min_persons) {
      add_note(line, "attempts with fewer than " + std::to_string(min_persons) + " values are left out");
      continue;
    }
    attempts.push_back(attempt);
    means.push_back(to_twelve_digits(statistics::mean_of(values)));
  }
  add_value(line, "attempts", count_of(attempts.size()));
  const auto fit = statistics::learning_fit(attempts, means);
  add_note(line, fit.note);
  if (!fit) return line;
  add_estimate(line, "start", fit->start, fit->start_interval);
  add_estimate(line, "plateau", fit->plateau, fit->plateau_interval);
  add_estimate(line, "rate", fit->rate, fit->rate_interval);
  return line;
}

}  // namespace

void add_value(ValidityLine& line, const std::string& name, double value) {
  if (std::isfinite(value))
    line.values.emplace_back(name, value);
  else
    add_note(line, name + " is not finite");
}

void add_interval(ValidityLine& line, const std::string& name, const std::optional<Interval>& interval) {
  if (!interval) return;
  add_value(line, name + "_low", interval->low);
  add_value(line, name + "_high", interval->high);
}

void add_estimate(ValidityLine& line, const std::string& name, double value,
                  const std::optional<Interval>& interval) {
  add_value(line, name, value);
  add_interval(line, name, interval);
}

void add_note(ValidityLine& line, const std::string& note) {
  if (!note.empty() && std::find(line.notes.begin(), line.notes.end(), note) == line.notes.end())
    line.notes.push_back(note);
}

void add_holm(std::vector<ValidityLine>& lines, const std::string& name) {
  std::vector<ValidityLine*> judged;
  std::vector<double> p_values;
  for (ValidityLine& line : lines)
    for (const auto& [key, value] : line.values)
      if (key == name) {
        judged.push_back(&line);
        p_values.push_back(value);
      }
  const std::vector<double> adjusted = statistics::adjusted_by_holm(p_values);
  for (size_t i = 0; i < judged.size(); ++i) add_value(*judged[i], name + "_holm", adjusted[i]);
}

std::vector<ValidityLine> agreement_lines(const ValidityInput& input) {
  const std::set<std::string> rated = rated_items(input);
  std::vector<ValidityLine> lines;
  for (const RatedItem& item : input.items)
    if (item.kind == ItemKind::scale && rated.contains(item.id))
      lines.push_back(agreement_line(item.id, RatingTable::of_item(input, item)));
  if (!lines.empty()) lines.push_back(agreement_line(raters_total, RatingTable::of_total(input)));
  return lines;
}

std::vector<ValidityLine> checklist_lines(const ValidityInput& input) {
  const std::set<std::string> rated = rated_items(input);
  std::vector<ValidityLine> lines;
  for (const RatedItem& item : input.items)
    if (item.kind == ItemKind::check && rated.contains(item.id))
      lines.push_back(checklist_line(item.id, RatingTable::of_item(input, item)));
  return lines;
}

std::vector<ValidityLine> known_group_lines(const ValidityInput& input,
                                            const std::vector<RatedSession>& sessions) {
  const statistics::Bootstrap bootstrap{.seed = input.bootstrap_seed, .samples = input.bootstrap_samples};
  std::vector<ValidityLine> lines;
  for (const std::string& measure : measures_of(sessions))
    lines.push_back(known_group_line(measure, group_values(sessions, "expert", measure),
                                     group_values(sessions, "novice", measure), bootstrap));
  add_holm(lines, "welch_p");
  add_holm(lines, "mann_whitney_p");
  return lines;
}

std::vector<ValidityLine> correlation_lines(const std::vector<RatedSession>& sessions) {
  std::vector<ValidityLine> lines;
  for (const std::string& measure : measures_of(sessions))
    if (measure != raters_total) lines.push_back(correlation_line(sessions, measure));
  add_holm(lines, "pearson_p");
  add_holm(lines, "spearman_p");
  return lines;
}

std::vector<ValidityLine> benchmark_lines(const std::vector<RatedSession>& sessions) {
  std::vector<ValidityLine> lines;
  for (const std::string& measure : measures_of(sessions))
    lines.push_back(benchmark_line(measure, group_values(sessions, "expert", measure)));
  return lines;
}

std::vector<ValidityLine> learning_lines(const std::vector<RatedSession>& sessions) {
  std::vector<ValidityLine> lines;
  for (const std::string& measure : measures_of(sessions)) lines.push_back(learning_line(sessions, measure));
  return lines;
}

}  // namespace ream::study
