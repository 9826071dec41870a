#include "store/migrations.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <migration_files.hpp>
#include <set>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "store/connection_pool.hpp"
#include "store/database_url.hpp"
#include "store/dialect.hpp"
#include "store/sql.hpp"

namespace ream::store {
namespace fs = std::filesystem;
namespace {

/// "001_sessions.sql" -> 1.
int number_of(const std::string& file) { return std::stoi(file.substr(0, file.find('_'))); }

std::vector<Migration> embedded_migrations() {
  std::vector<Migration> found;
  std::string_view names = REAM_MIGRATIONS;
  while (!names.empty()) {
    const size_t end = std::min(names.find(','), names.size());
    const std::string file(names.substr(0, end));
    found.push_back({number_of(file), file, std::string(embedded::migration_files::find(file))});
    names.remove_prefix(std::min(end + 1, names.size()));
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  return found;
}

/// Those that have run, of the table that knows it.
std::set<int> done(Sql& sql) {
  std::set<int> numbers;
  int number = 0;
  for_each_row((sql.prepare << "SELECT number FROM migrations", into(number)),
               [&] { numbers.insert(number); });
  return numbers;
}

/// `unknown`: steps that the database has run, and that this build does not have.
void refuse_newer(const std::set<int>& unknown) {
  if (unknown.empty()) return;
  throw Error(ErrorKind::conflict, "a newer version of ream has changed the database's tables (step " +
                                       std::to_string(*unknown.rbegin()) + "); update this one");
}

void run_statements(Sql& sql, const std::string& statements) {
  constexpr std::string_view end = ";\n";
  size_t from = 0;
  for (size_t at = statements.find(end); at != std::string::npos; at = statements.find(end, from)) {
    sql << in_dialect(sql, statements.substr(from, at - from));
    from = at + end.size();
  }
}

/// Their numbers, in order.
std::vector<int> missing_steps(const DatabaseUrl& url) {
  ConnectionPool pool(url, {});
  const auto lease = pool.take();
  begin_reading(lease->sql());
  std::set<int> before;
  if (!columns_of(lease->sql(), "migrations").empty()) before = done(lease->sql());
  lease->sql() << "ROLLBACK";
  std::vector<int> missing;
  for (const Migration& step : migrations())
    if (before.erase(step.number) == 0) missing.push_back(step.number);
  refuse_newer(before);
  return missing;
}

/// As it is at this moment, also while others write to it. `to`: an empty file.
void copy_sqlite_file(const DatabaseUrl& url, const fs::path& to) {
  ConnectionPool pool(url, {});
  const auto lease = pool.take();
  const std::string name = to.string();
  try {
    lease->sql() << "VACUUM INTO :name", use(name);
  } catch (const soci::soci_error& error) {
    throw Error(ErrorKind::io, "cannot keep a copy of the database " + url.shown + " at " + name + ": " +
                                   error.what() + "; make room on the disk");
  }
}

}  // namespace

const std::vector<Migration>& migrations() {
  static const std::vector<Migration> all = embedded_migrations();
  return all;
}

std::vector<std::string> table_names() {
  constexpr std::string_view making = "CREATE TABLE ";
  std::vector<std::string> names;
  for (const Migration& step : migrations()) {
    const std::string& text = step.statements;
    for (size_t at = text.find(making); at != std::string::npos; at = text.find(making, at)) {
      at += making.size();
      names.push_back(text.substr(at, text.find_first_of(" (\n", at) - at));
    }
  }
  return names;
}

void migrate(Sql& sql) {
  lock_for_migration(sql);
  sql << in_dialect(sql,
                    "CREATE TABLE IF NOT EXISTS migrations (number BIGINT PRIMARY KEY, name TEXT NOT NULL)");
  std::set<int> before = done(sql);
  for (const Migration& step : migrations()) {
    if (before.erase(step.number) > 0) continue;
    run_statements(sql, step.statements);
    sql << "INSERT INTO migrations (number, name) VALUES (:number, :name)", use(step.number), use(step.name);
  }
  refuse_newer(before);
}

size_t missing_migrations(const std::string& url) {
  const DatabaseUrl parsed = parse_database_url(url);
  return is_there(parsed) ? missing_steps(parsed).size() : migrations().size();
}

fs::path keep_before_migration(const std::string& url) {
  const DatabaseUrl parsed = parse_database_url(url);
  if (parsed.postgresql || !is_there(parsed)) return {};
  const std::vector<int> missing = missing_steps(parsed);
  if (missing.empty() || missing.size() == migrations().size()) return {};
  std::array<char, 8> number{};
  std::snprintf(number.data(), number.size(), "%03d", missing.front());
  const fs::path kept = parsed.file.string() + ".before-" + number.data();
  std::error_code failed;
  if (fs::exists(kept, failed)) return {};
  AtomicFile copy(kept);
  copy_sqlite_file(parsed, copy.path());
  // Another process may have run the steps meanwhile; then it has kept its own copy.
  DatabaseUrl copied = parsed;
  copied.file = copy.path();
  if (missing_steps(copied) != missing) return {};
  copy.commit();
  return kept;
}

}  // namespace ream::store
