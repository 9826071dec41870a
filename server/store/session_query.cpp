#include "store/session_query.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/error.hpp"
#include "core/text.hpp"

namespace ream::store {
namespace {

constexpr std::array<const char*, 6> order_words{"created_utc", "duration_s", "case",
                                                 "trainee",     "state",      "points"};

std::string number_text(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

std::string key_of(SessionOrder order, const SessionRow& row) {
  switch (order) {
    case SessionOrder::created:
      return row.created_utc;
    case SessionOrder::duration:
      return number_text(row.duration_s);
    case SessionOrder::case_id:
      return row.case_id;
    case SessionOrder::trainee:
      return row.trainee;
    case SessionOrder::state:
      return row.state;
    case SessionOrder::points:
      return number_text(row.points.value_or(without_points));
  }
  return {};
}

/// Less than zero: `a` comes first in ascending order.
int compare(SessionOrder order, const SessionPlace& a, const SessionPlace& b) {
  if (by_number(order)) {
    const double first = number_of(a), second = number_of(b);
    if (first != second) return first < second ? -1 : 1;
  } else if (const int keys = a.key.compare(b.key); keys != 0) {
    return keys;
  }
  return a.id.compare(b.id);
}

SessionPlace place_of(SessionOrder order, const SessionRow& row) { return {key_of(order, row), row.id}; }

/// The order of a cursor, so that it is not used for another one.
std::string order_mark(const SessionQuery& query) {
  return std::string(query.descending ? "-" : "+") + order_words[static_cast<size_t>(query.order)];
}

bool is_or_any(const std::string& wanted, const std::string& value) {
  return wanted.empty() || wanted == value;
}

bool is_among(const std::vector<std::string>& wanted, const std::string& value) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), value) != wanted.end();
}

bool has_wanted_points(const SessionQuery& query, const SessionRow& row) {
  if (!query.points_from && !query.points_to) return true;
  return row.points && *row.points >= query.points_from.value_or(*row.points) &&
         *row.points <= query.points_to.value_or(*row.points);
}

}  // namespace

bool by_number(SessionOrder order) {
  return order == SessionOrder::duration || order == SessionOrder::points;
}

double number_of(const SessionPlace& place) {
  double number = 0.0;
  std::from_chars(place.key.data(), place.key.data() + place.key.size(), number);
  return number;
}

std::optional<SessionOrder> session_order_from(const std::string& word) {
  const auto found = std::find(order_words.begin(), order_words.end(), word);
  if (found == order_words.end()) return std::nullopt;
  return static_cast<SessionOrder>(found - order_words.begin());
}

bool matches(const SessionQuery& query, const SessionRow& row) {
  if (!is_among(query.states, row.state) || !has_wanted_points(query, row) ||
      !is_among(query.outcomes, row.outcome.empty() ? "none" : row.outcome))
    return false;
  if (!is_or_any(query.case_id, row.case_id) || !is_or_any(query.trainee_id, row.trainee_id) ||
      !is_or_any(query.study, row.study) || !is_or_any(query.participant, row.participant))
    return false;
  if (query.outside_studies && !row.study.empty()) return false;
  if (row.created_utc < query.created_from) return false;
  if (!query.created_before.empty() && row.created_utc >= query.created_before) return false;
  const std::string text = searched_text(row);
  const auto words = searched_words(query);
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

bool behind(const SessionQuery& query, const SessionPlace& place, const SessionRow& row) {
  const int order = compare(query.order, place, place_of(query.order, row));
  return query.descending ? order > 0 : order < 0;
}

bool precedes(const SessionQuery& query, const SessionRow& a, const SessionRow& b) {
  return behind(query, place_of(query.order, a), b);
}

std::string cursor_behind(const SessionQuery& query, const SessionRow& row) {
  const SessionPlace place = place_of(query.order, row);
  return hex_of(order_mark(query) + '\n' + place.id + '\n' + place.key);
}

std::optional<SessionPlace> place_of_cursor(const SessionQuery& query) {
  if (query.cursor.empty()) return std::nullopt;
  const std::string text = bytes_from_hex(query.cursor), mark = order_mark(query) + '\n';
  const size_t end = text.find('\n', mark.size());
  if (!text.starts_with(mark) || end == std::string::npos || text.find('\0') != std::string::npos)
    throw Error(ErrorKind::invalid_input,
                "cursor is none that this list has given; leave it out to begin with the first page");
  return SessionPlace{text.substr(end + 1), text.substr(mark.size(), end - mark.size())};
}

}  // namespace ream::store
