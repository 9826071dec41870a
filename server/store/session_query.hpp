#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ream::store {

/// A session as lists know it: what they filter and sort by, and all that they show of it.
struct SessionRow {
  std::string id;
  std::string case_id, script;
  std::string state;        ///< the word of session.json
  std::string created_utc;  ///< "2026-01-31T12:00:00Z"
  double duration_s = 0.0;
  std::string trainee_id, trainee;  ///< user's id and name to show; empty without users
  std::string study, participant;   ///< empty outside studies
  std::string title;                ///< may be empty
  std::optional<double> points;     ///< of its score, 0 to 100; none: not judged, or nothing is said
  std::string outcome;              ///< pass, fail or undecided; empty: none
  std::string record;               ///< for the owner of the index: what the folder says, any text
  int64_t stamp = 0;                ///< of the folder's files when it was read; another stamp: read it again
  bool lasting = true;              ///< false: may change its state without a new stamp (it was left live)

  bool operator==(const SessionRow&) const = default;
};

/// What a list is sorted by; equals by id, in the same direction. Those without points stand below those with
/// 0.
enum class SessionOrder { created, duration, case_id, trainee, state, points };

/// "created_utc", "duration_s", "case", "trainee", "state" or "points"; empty for other words.
std::optional<SessionOrder> session_order_from(const std::string& word);

/// Which sessions are wanted, and in which order. Empty filters let everything pass.
struct SessionQuery {
  std::vector<std::string> states;               ///< any of these
  std::string case_id, trainee_id;               ///< exactly
  std::string study, participant;                ///< exactly
  std::vector<std::string> without_studies;      ///< of none of these
  bool outside_studies = false;                  ///< of no study only
  std::string created_from, created_before;      ///< UTC as created_utc, or the beginning of one ("2026-01")
  std::vector<std::string> outcomes;             ///< any of these; "none" for those without
  std::optional<double> points_from, points_to;  ///< both included; sessions without points do not pass
  std::string text;  ///< words that id, case, script, names or title hold, in any case
  SessionOrder order = SessionOrder::created;
  bool descending = true;
  size_t limit = 50;   ///< most rows of one page
  std::string cursor;  ///< of the page before; empty: the first page
};

/// Place in a list: behind the row with these two.
struct SessionPlace {
  std::string key;  ///< text that is sorted by; of durations and points the number
  std::string id;
};

/// Whether the filters let it pass (the cursor is none of them).
bool matches(const SessionQuery& query, const SessionRow& row);
/// Whether `a` stands before `b` in the list.
bool precedes(const SessionQuery& query, const SessionRow& a, const SessionRow& b);
/// Whether the row stands behind the place.
bool behind(const SessionQuery& query, const SessionPlace& place, const SessionRow& row);

/// Opaque, for URLs: the list goes on behind this row.
std::string cursor_behind(const SessionQuery& query, const SessionRow& row);
/// Place of the query's cursor; none for the first page. Error invalid_input for what is no cursor, or one of
/// another order.
std::optional<SessionPlace> place_of_cursor(const SessionQuery& query);

/// Whether a list is sorted by a number, and that of a place in it.
bool by_number(SessionOrder order);
double number_of(const SessionPlace& place);

/// What stands for points that there are none of, in the order of a list.
inline constexpr double without_points = -1.0;

/// Letters small, so that a search finds them in any case.
std::string folded(const std::string& utf8);
/// All that a search looks at, folded.
std::string searched_text(const SessionRow& row);
/// The folded words of a search.
std::vector<std::string> searched_words(const SessionQuery& query);

}  // namespace ream::store
