#include "store/session_query.hpp"

#include <locale.h>
#include <wctype.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cwchar>
#include <sstream>

#include "core/error.hpp"
#include "core/text.hpp"

namespace ream::store {
namespace {

constexpr std::array<const char*, 6> order_names{"created_utc", "duration_s", "case",
                                                 "trainee",     "state",      "points"};

std::string number_text(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

std::string key_of(SessionOrder order, const SessionRow& row) {
  switch (order) {
    case SessionOrder::created: return row.created_utc;
    case SessionOrder::duration: return number_text(row.duration_s);
    case SessionOrder::case_id: return row.case_id;
    case SessionOrder::trainee: return row.trainee;
    case SessionOrder::state: return row.state;
    case SessionOrder::points: return number_text(row.points.value_or(without_points));
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
  return std::string(query.descending ? "-" : "+") + order_names[static_cast<size_t>(query.order)];
}

bool matches_filter(const std::string& filter, const std::string& value) {
  return filter.empty() || filter == value;
}

bool is_any_of(const std::vector<std::string>& filter, const std::string& value) {
  return filter.empty() || std::find(filter.begin(), filter.end(), value) != filter.end();
}

bool matches_points(const SessionQuery& query, const SessionRow& row) {
  if (!query.points_from && !query.points_to) return true;
  return row.points && *row.points >= query.points_from.value_or(*row.points) &&
         *row.points <= query.points_to.value_or(*row.points);
}

/// The C library reads and writes UTF-8 on this thread as long as it lives.
class Utf8Thread {
 public:
  Utf8Thread() : before_(::uselocale(utf8())) {}
  ~Utf8Thread() { ::uselocale(before_); }
  Utf8Thread(const Utf8Thread&) = delete;
  Utf8Thread& operator=(const Utf8Thread&) = delete;

 private:
  static locale_t utf8() {
    static const locale_t locale = ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    return locale;
  }
  const locale_t before_;
};

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
  const auto found = std::find(order_names.begin(), order_names.end(), word);
  if (found == order_names.end()) return std::nullopt;
  return static_cast<SessionOrder>(found - order_names.begin());
}

bool matches(const SessionQuery& query, const SessionRow& row) {
  if (!is_any_of(query.states, row.state) || !matches_points(query, row) ||
      !is_any_of(query.outcomes, row.outcome.empty() ? "none" : row.outcome))
    return false;
  if (!matches_filter(query.case_id, row.case_id) || !matches_filter(query.trainee_id, row.trainee_id) ||
      !matches_filter(query.study, row.study) || !matches_filter(query.participant, row.participant))
    return false;
  if (query.outside_studies && !row.study.empty()) return false;
  const auto& without = query.without_studies;
  if (std::find(without.begin(), without.end(), row.study) != without.end()) return false;
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

std::string folded(const std::string& utf8) {
  const Utf8Thread thread;
  std::string text;
  std::mbstate_t reading{}, writing{};
  for (size_t at = 0; at < utf8.size();) {
    wchar_t letter = 0;
    const size_t length = std::mbrtowc(&letter, utf8.data() + at, utf8.size() - at, &reading);
    char bytes[MB_LEN_MAX];
    const bool readable = length != 0 && length <= utf8.size() - at;
    const size_t made =
        readable
            ? std::wcrtomb(bytes, static_cast<wchar_t>(::towlower(static_cast<wint_t>(letter))), &writing)
            : MB_LEN_MAX + 1;
    if (made <= MB_LEN_MAX)
      text.append(bytes, made);
    else
      text += utf8[at];
    if (!readable) reading = {};
    at += readable ? length : 1;
  }
  return text;
}

std::string searched_text(const SessionRow& row) {
  std::string text;
  for (const std::string& part :
       {row.id, row.title, row.trainee, row.participant, row.study, row.case_id, row.script})
    if (!part.empty()) text += part + '\n';
  return folded(text);
}

std::vector<std::string> searched_words(const SessionQuery& query) {
  std::istringstream text(folded(query.text));
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

}  // namespace ream::store
