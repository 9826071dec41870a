#include "store/session_index.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "store/sql.hpp"

namespace ream::store {
namespace {

/// In order of SessionOrder.
constexpr std::array<const char*, 6> order_columns{"created_utc", "duration_s", "case_id",
                                                   "trainee",     "state",      "points"};

/// Puts row after row by statements that are prepared once.
class RowWriter {
 public:
  explicit RowWriter(Sql& sql) : session_(session_statement(sql)), record_(record_statement(sql)) {}

  void write(const SessionRow& row) {
    row_ = row;
    search_ = searched_text(row);
    lasting_ = row.lasting ? 1 : 0;
    points_ = row.points.value_or(without_points);
    for (std::string* text : texts()) *text = storable(*text);
    session_.execute(true);
    record_.execute(true);
  }

 private:
  /// In the order of their parameters, and the record.
  std::vector<std::string*> texts() {
    return {&row_.id,         &row_.case_id, &row_.script, &row_.state,       &row_.created_utc,
            &row_.trainee_id, &row_.trainee, &row_.study,  &row_.participant, &row_.title,
            &search_,         &row_.outcome, &row_.record};
  }
  soci::statement session_statement(Sql& sql);
  soci::statement record_statement(Sql& sql);

  SessionRow row_;
  std::string search_;
  int lasting_ = 0;
  double points_ = without_points;
  soci::statement session_, record_;
};

soci::statement RowWriter::session_statement(Sql& sql) {
  OpenStatement statement(
      sql,
      "INSERT INTO sessions (id, case_id, script, state, created_utc, trainee_id, trainee, study, "
      "participant, "
      "title, search, outcome, duration_s, stamp, lasting, points) VALUES (:id, :case_id, :script, :state, "
      ":created_utc, "
      ":trainee_id, :trainee, :study, :participant, :title, :search, :outcome, :duration_s, :stamp, "
      ":lasting, :points) "
      "ON CONFLICT (id) DO UPDATE SET case_id = excluded.case_id, script = excluded.script, "
      "state = excluded.state, created_utc = excluded.created_utc, duration_s = excluded.duration_s, "
      "trainee_id = excluded.trainee_id, trainee = excluded.trainee, study = excluded.study, "
      "participant = excluded.participant, title = excluded.title, search = excluded.search, "
      "stamp = excluded.stamp, lasting = excluded.lasting, points = excluded.points, "
      "outcome = excluded.outcome");
  for (const std::string* text : texts())
    if (text != &row_.record) statement.with(*text);
  return statement.with(row_.duration_s).with(row_.stamp).with(lasting_).with(points_).prepared();
}

soci::statement RowWriter::record_statement(Sql& sql) {
  OpenStatement statement(sql,
                          "INSERT INTO session_records (id, record) VALUES (:id, :record) "
                          "ON CONFLICT (id) DO UPDATE SET record = excluded.record");
  return statement.with(row_.id).with(row_.record).prepared();
}

void put_rows(Sql& sql, const std::vector<SessionRow>& rows) {
  RowWriter writer(sql);
  for (const SessionRow& row : rows) writer.write(row);
}

/// A WHERE clause that grows, with the values of its parameters in order.
class Conditions {
 public:
  void add(const std::string& condition) { text_ += (text_.empty() ? " WHERE " : " AND ") + condition; }
  void add(const std::string& condition, const std::string& value) {
    add(condition);
    texts_.push_back(value);
  }
  void add_if_given(const std::string& condition, const std::string& value) {
    if (!value.empty()) add(condition, value);
  }
  /// `column` is one of `values`, or with `none` none of them. No condition without values.
  void add_set(const std::string& column, const std::vector<std::string>& values, bool none) {
    if (values.empty()) return;
    std::string list;
    for (const std::string& value : values) {
      list += list.empty() ? ":v" : ", :v";
      list += std::to_string(texts_.size());
      texts_.push_back(value);
    }
    add(column + (none ? " NOT IN (" : " IN (") + list + ")");
  }

  const std::string& text() const { return text_; }
  const std::vector<std::string>& values() const { return texts_; }
  std::string next_name() const { return ":v" + std::to_string(texts_.size()); }

 private:
  std::string text_;
  std::vector<std::string> texts_;
};

/// With '%' before and behind, and what LIKE would read otherwise escaped.
std::string pattern_of(const std::string& word) {
  std::string pattern = "%";
  for (const char c : word) {
    if (c == '%' || c == '_' || c == '\\') pattern += '\\';
    pattern += c;
  }
  return pattern + "%";
}

/// As it stands in a statement.
std::string literal(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

void add_marks(const SessionQuery& query, Conditions& conditions) {
  std::vector<std::string> outcomes = query.outcomes;
  std::replace(outcomes.begin(), outcomes.end(), std::string("none"), std::string());
  conditions.add_set("outcome", outcomes, false);
  if (query.points_from || query.points_to) conditions.add("points >= 0");
  if (query.points_from) conditions.add("points >= " + literal(*query.points_from));
  if (query.points_to) conditions.add("points <= " + literal(*query.points_to));
}

Conditions filters_of(const SessionQuery& query, const std::vector<std::string>& except) {
  Conditions conditions;
  conditions.add_set("id", except, true);
  conditions.add_set("state", query.states, false);
  for (const auto& [column, value] : {std::pair{"case_id = ", &query.case_id},
                                      {"trainee_id = ", &query.trainee_id},
                                      {"study = ", &query.study},
                                      {"participant = ", &query.participant},
                                      {"created_utc >= ", &query.created_from},
                                      {"created_utc < ", &query.created_before}})
    conditions.add_if_given(column + conditions.next_name(), *value);
  add_marks(query, conditions);
  if (query.outside_studies) conditions.add("study = ''");
  for (const std::string& study : query.without_studies)
    conditions.add("study <> " + conditions.next_name(), study);
  for (const std::string& word : searched_words(query))
    conditions.add("search LIKE " + conditions.next_name() + " ESCAPE '\\'", pattern_of(word));
  return conditions;
}

/// What a row is read into where its own fields are of other types.
struct RowReader {
  SessionRow row;
  int lasting = 0;
  double points = without_points;

  SessionRow whole() const {
    SessionRow made = row;
    made.lasting = lasting != 0;
    made.points = points < 0.0 ? std::nullopt : std::optional(points);
    return made;
  }
};

void read_columns(OpenStatement& statement, RowReader& read) {
  SessionRow& row = read.row;
  statement.into(row.id).into(row.case_id).into(row.script).into(row.state).into(row.created_utc);
  statement.into(row.duration_s).into(row.trainee_id).into(row.trainee).into(row.study);
  statement.into(row.participant).into(row.title).into(row.stamp).into(read.lasting).into(read.points);
  statement.into(row.outcome).into(row.record);
}

/// Rows of `from`, a query that gives all columns of the table, with their records.
std::string with_records(const std::string& from) {
  return "SELECT p.id, case_id, script, state, created_utc, duration_s, trainee_id, trainee, study, "
         "participant, "
         "title, stamp, lasting, points, outcome, record FROM (" +
         from + ") p JOIN session_records r ON r.id = p.id";
}

size_t count(Sql& sql, const Conditions& conditions) {
  long long total = 0;
  OpenStatement statement(sql, "SELECT count(*) FROM sessions" + conditions.text());
  for (const std::string& value : conditions.values()) statement.with(value);
  statement.into(total).each([] {});
  return static_cast<size_t>(total);
}

std::vector<SessionRow> page(Sql& sql, const SessionQuery& query, Conditions conditions) {
  const auto place = place_of_cursor(query);
  const std::string key = order_columns[static_cast<size_t>(query.order)];
  const std::string direction = query.descending ? " DESC" : " ASC";
  const auto order = [&](const std::string& id) {
    return " ORDER BY " + key + direction + ", " + id + direction;
  };
  if (place) conditions.add("(" + key + ", id) " + (query.descending ? "<" : ">") + " (:key, :id)");
  OpenStatement statement(
      sql, with_records("SELECT * FROM sessions" + conditions.text() + order("id") + " LIMIT :rows") +
               order("p.id"));
  for (const std::string& value : conditions.values()) statement.with(value);
  const bool numbers = by_number(query.order);
  const double number = place && numbers ? number_of(*place) : 0.0;
  if (place && numbers) statement.with(number).with(place->id);
  if (place && !numbers) statement.with(place->key).with(place->id);
  const auto max_rows = static_cast<long long>(std::min<size_t>(query.limit, INT64_MAX - 1) + 1);
  statement.with(max_rows);
  std::vector<SessionRow> rows;
  RowReader read;
  read_columns(statement, read);
  statement.each([&] { rows.push_back(read.whole()); });
  return rows;
}

}  // namespace

void SessionIndex::put(const std::vector<SessionRow>& rows) {
  if (!rows.empty()) database_.run([&](Sql& sql) { put_rows(sql, rows); });
}

void SessionIndex::remove(const std::vector<std::string>& ids) {
  if (ids.empty()) return;
  database_.run([&](Sql& sql) {
    for (const std::string& id : ids) sql << "DELETE FROM sessions WHERE id = :id", use(id);
  });
}

void SessionIndex::replace_all(const std::vector<SessionRow>& rows) {
  database_.run_at_length([&](Sql& sql) {
    sql << "DELETE FROM sessions";
    put_rows(sql, rows);
  });
}

std::optional<SessionRow> SessionIndex::get(const std::string& id) const {
  return database_.read([&](Sql& sql) {
    std::optional<SessionRow> found;
    RowReader read;
    OpenStatement statement(sql, with_records("SELECT * FROM sessions WHERE id = :id"));
    statement.with(id);
    read_columns(statement, read);
    statement.each([&] { found = read.whole(); });
    return found;
  });
}

std::map<std::string, SessionIndex::Mark> SessionIndex::marks() const {
  return database_.read([](Sql& sql) {
    std::map<std::string, Mark> found;
    std::string id;
    Mark mark;
    int lasting = 0;
    OpenStatement statement(sql, "SELECT id, stamp, lasting FROM sessions");
    statement.into(id).into(mark.stamp).into(lasting).each([&] {
      mark.lasting = lasting != 0;
      found[id] = mark;
    });
    return found;
  });
}

SessionIndex::Found SessionIndex::find(const SessionQuery& query,
                                       const std::vector<std::string>& except) const {
  const Conditions filters = filters_of(query, except);
  return database_.read([&](Sql& sql) { return Found{page(sql, query, filters), count(sql, filters)}; });
}

}  // namespace ream::store
