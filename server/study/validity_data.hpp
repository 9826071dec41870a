#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "statistics/intraclass.hpp"
#include "study/validity_report.hpp"

namespace ream::study {

/// Error invalid_input as validity_report() says.
void check_validity_input(const ValidityInput& input);

/// The sessions with the mean of the raters' totals among their measures, where a rater has rated all scale
/// items of which there is any rating.
std::vector<RatedSession> with_raters_total(const ValidityInput& input);

/// Names of all measures, sorted.
std::vector<std::string> measures_of(const std::vector<RatedSession>& sessions);

/// A measure's value in a session, if there is one.
std::optional<double> measure_in(const RatedSession& session, const std::string& measure);

/// The value to 12 significant digits. Means of the same numbers in another order are then equal, and so are
/// ties among them.
double to_twelve_digits(double value);

/// Of each participant (by code) the mean over those sessions for which `value` gives one, to 12 digits.
template <typename Value>
std::map<std::string, double> person_means(const std::vector<RatedSession>& sessions, const Value& value) {
  std::map<std::string, std::pair<double, size_t>> sums;
  for (const RatedSession& session : sessions)
    if (const std::optional<double> found = value(session)) {
      sums[session.participant].first += *found;
      ++sums[session.participant].second;
    }
  std::map<std::string, double> means;
  for (const auto& [person, sum] : sums)
    means[person] = to_twelve_digits(sum.first / static_cast<double>(sum.second));
  return means;
}

/// What groups are compared by: a value of each participant of this experience (by code), before a study has
/// changed anything. Where sessions have phases, the mean of those of the phase pre; where none is of that
/// phase, the first session with a value, by attempt (not known: last), then in the order given. Without
/// phases, the mean of all sessions.
std::map<std::string, double> group_means(const std::vector<RatedSession>& sessions,
                                          const std::string& experience, const std::string& measure);

/// What raters say of sessions, a row for each session that anybody rated so.
class RatingTable {
 public:
  /// Of one item. Raters and sessions are those of the table of all items of its kind.
  static RatingTable of_item(const ValidityInput& input, const RatedItem& item);
  /// Of the sum of all scale items of which there is any rating; empty where a rater has left one out.
  static RatingTable of_total(const ValidityInput& input);

  const std::vector<statistics::RatingRow>& rows() const { return rows_; }
  const std::vector<std::string>& sessions() const { return sessions_; }
  size_t raters() const { return raters_.size(); }
  const std::string& rater(size_t column) const { return raters_[column]; }

 private:
  RatingTable(const ValidityInput& input, ItemKind kind);
  std::optional<double>& cell(const Rating& rating);

  std::vector<std::string> raters_, sessions_;  ///< sorted
  std::vector<statistics::RatingRow> rows_;
};

}  // namespace ream::study
