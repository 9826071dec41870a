#include "study/validity_data.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "study/study.hpp"

namespace ream::study {
namespace {

[[noreturn]] void refuse_validity(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "validity report: " + what);
}

bool is_one_of(const std::string& word, const std::vector<std::string>& words) {
  return word.empty() || std::find(words.begin(), words.end(), word) != words.end();
}

std::map<std::string, ItemKind> kinds_of(const std::vector<RatedItem>& items) {
  std::map<std::string, ItemKind> kinds;
  for (const RatedItem& item : items)
    if (!kinds.emplace(item.id, item.kind).second) refuse_validity("item '" + item.id + "' is there twice");
  return kinds;
}

/// Of participants: one experience, one arm.
void check_person(std::map<std::string, std::string>& known, const RatedSession& session,
                  const std::string& word, const char* what) {
  const auto [entry, fresh] = known.emplace(session.participant, word);
  if (!fresh && entry->second != word)
    refuse_validity("participant '" + session.participant + "' has two " + what + ", '" + entry->second +
                    "' and '" + word + "'");
}

void check_sessions(const std::vector<RatedSession>& sessions) {
  static const std::vector<std::string> phases = {"pre", "training", "post", "retention"};
  std::set<std::string> ids;
  std::map<std::string, std::string> experiences, arms;
  for (const RatedSession& session : sessions) {
    if (!ids.insert(session.session).second)
      refuse_validity("session '" + session.session + "' is there twice");
    if (session.participant.empty()) refuse_validity("session '" + session.session + "' has no participant");
    if (!is_one_of(session.experience, experience_levels))
      refuse_validity("experience '" + session.experience + "' is not novice, intermediate or expert");
    if (!is_one_of(session.phase, phases))
      refuse_validity("phase '" + session.phase + "' is not pre, training, post or retention");
    if (session.measures.contains(raters_total))
      refuse_validity("'" + raters_total + "' is what the raters say; no measure may be called so");
    check_person(experiences, session, session.experience, "experiences");
    check_person(arms, session, session.arm, "arms");
  }
}

template <typename Condition>
bool any_session(const std::vector<RatedSession>& sessions, const Condition& has) {
  return std::any_of(sessions.begin(), sessions.end(), has);
}

bool comes_before(const RatedSession& one, const RatedSession& other) {
  return one.attempt > 0 && (other.attempt <= 0 || one.attempt < other.attempt);
}

}  // namespace

void check_validity_input(const ValidityInput& input) {
  check_sessions(input.sessions);
  std::set<std::string> sessions;
  for (const RatedSession& session : input.sessions) sessions.insert(session.session);
  const std::map<std::string, ItemKind> kinds = kinds_of(input.items);
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  for (const Rating& rating : input.ratings) {
    const std::string name =
        "rating of '" + rating.item + "' in session '" + rating.session + "' by '" + rating.rater + "'";
    if (!sessions.contains(rating.session)) refuse_validity(name + ": there is no such session");
    const auto kind = kinds.find(rating.item);
    if (kind == kinds.end()) refuse_validity(name + ": there is no such item");
    if (!seen.emplace(rating.rater, rating.session, rating.item).second)
      refuse_validity(name + " is there twice");
    const bool scale = kind->second == ItemKind::scale;
    if (scale ? !(rating.value >= 1.0 && rating.value <= 5.0) : rating.value != 0.0 && rating.value != 1.0)
      refuse_validity(name + (scale ? " must be 1 to 5" : " must be 0 or 1"));
  }
}

std::optional<double> measure_in(const RatedSession& session, const std::string& measure) {
  const auto found = session.measures.find(measure);
  if (found == session.measures.end() || !std::isfinite(found->second)) return std::nullopt;
  return found->second;
}

double to_twelve_digits(double value) {
  std::array<char, 32> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 11).ptr;
  std::from_chars(text.data(), end, value);
  return value;
}

std::vector<RatedSession> with_raters_total(const ValidityInput& input) {
  std::vector<RatedSession> sessions = input.sessions;
  const RatingTable totals = RatingTable::of_total(input);
  std::map<std::string, double> mean;
  for (size_t i = 0; i < totals.rows().size(); ++i) {
    double sum = 0.0;
    size_t raters = 0;
    for (const std::optional<double>& total : totals.rows()[i])
      if (total) {
        sum += *total;
        ++raters;
      }
    if (raters > 0) mean[totals.sessions()[i]] = sum / static_cast<double>(raters);
  }
  for (RatedSession& session : sessions)
    if (const auto found = mean.find(session.session); found != mean.end())
      session.measures[raters_total] = found->second;
  return sessions;
}

std::vector<std::string> measures_of(const std::vector<RatedSession>& sessions) {
  std::set<std::string> names;
  for (const RatedSession& session : sessions)
    for (const auto& [name, value] : session.measures) names.insert(name);
  return {names.begin(), names.end()};
}

std::map<std::string, double> group_means(const std::vector<RatedSession>& sessions,
                                          const std::string& experience, const std::string& measure) {
  const auto value_of_group = [&](const RatedSession& session) {
    return session.experience == experience ? measure_in(session, measure) : std::nullopt;
  };
  if (any_session(sessions, [](const RatedSession& session) { return session.phase == "pre"; }))
    return person_means(sessions, [&](const RatedSession& session) {
      return session.phase == "pre" ? value_of_group(session) : std::nullopt;
    });
  if (!any_session(sessions, [](const RatedSession& session) { return !session.phase.empty(); }))
    return person_means(sessions, value_of_group);
  std::map<std::string, const RatedSession*> first;
  for (const RatedSession& session : sessions) {
    if (!value_of_group(session)) continue;
    const auto [entry, fresh] = first.emplace(session.participant, &session);
    if (!fresh && comes_before(session, *entry->second)) entry->second = &session;
  }
  return person_means(sessions, [&](const RatedSession& session) {
    const auto found = first.find(session.participant);
    return found != first.end() && found->second == &session ? value_of_group(session) : std::nullopt;
  });
}

RatingTable::RatingTable(const ValidityInput& input, ItemKind kind) {
  const std::map<std::string, ItemKind> kinds = kinds_of(input.items);
  std::set<std::string> raters, sessions;
  for (const Rating& rating : input.ratings)
    if (kinds.at(rating.item) == kind) {
      raters.insert(rating.rater);
      sessions.insert(rating.session);
    }
  raters_.assign(raters.begin(), raters.end());
  sessions_.assign(sessions.begin(), sessions.end());
  rows_.assign(sessions_.size(), statistics::RatingRow(raters_.size()));
}

std::optional<double>& RatingTable::cell(const Rating& rating) {
  const auto row = std::lower_bound(sessions_.begin(), sessions_.end(), rating.session);
  const auto column = std::lower_bound(raters_.begin(), raters_.end(), rating.rater);
  return rows_[static_cast<size_t>(row - sessions_.begin())][static_cast<size_t>(column - raters_.begin())];
}

RatingTable RatingTable::of_item(const ValidityInput& input, const RatedItem& item) {
  RatingTable table(input, item.kind);
  for (const Rating& rating : input.ratings)
    if (rating.item == item.id) table.cell(rating) = rating.value;
  return table;
}

RatingTable RatingTable::of_total(const ValidityInput& input) {
  RatingTable table(input, ItemKind::scale);
  const std::map<std::string, ItemKind> kinds = kinds_of(input.items);
  std::set<std::string> scales;
  std::map<std::pair<std::string, std::string>, size_t> rated;
  for (const Rating& rating : input.ratings) {
    if (kinds.at(rating.item) != ItemKind::scale) continue;
    std::optional<double>& sum = table.cell(rating);
    sum = sum.value_or(0.0) + rating.value;
    ++rated[{rating.session, rating.rater}];
    scales.insert(rating.item);
  }
  for (size_t i = 0; i < table.sessions_.size(); ++i)
    for (size_t j = 0; j < table.raters_.size(); ++j)
      if (rated[{table.sessions_[i], table.raters_[j]}] != scales.size()) table.rows_[i][j].reset();
  return table;
}

}  // namespace ream::study
