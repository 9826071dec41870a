#include "store/migrations.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <migration_files.hpp>
#include <set>
#include <span>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "store/connection_pool.hpp"
#include "store/database_url.hpp"
#include "store/dialect.hpp"
#include "store/sql.hpp"
#include "store/table_files.hpp"

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

constexpr const char* table_of_steps =
    "CREATE TABLE IF NOT EXISTS migrations (number BIGINT PRIMARY KEY, name TEXT NOT NULL)";

void run_step(Sql& sql, const Migration& step) {
  run_statements(sql, step.statements);
  sql << "INSERT INTO migrations (number, name) VALUES (:number, :name)", use(step.number), use(step.name);
}

/// `to`: an empty file. Tables of the same steps, and their rows.
void copy_to_sqlite(Sql& sql, Sql& to) {
  // All of it goes into the one file that is kept.
  to << "PRAGMA journal_mode = MEMORY";
  begin_writing(to);
  to << table_of_steps;
  const std::set<int> steps = done(sql);
  for (const Migration& step : migrations())
    if (steps.contains(step.number)) run_step(to, step);
  copy_tables(sql, to);
  to << "COMMIT";
}

/// As it is at this moment, also while others write to it. `to`: an empty file.
void copy_database(const DatabaseUrl& url, const fs::path& to) {
  ConnectionPool pool(url, {});
  const auto lease = pool.take();
  Sql& sql = lease->sql();
  const std::string name = to.string();
  try {
    if (!url.postgresql) {
      sql << "VACUUM INTO :name", use(name);
      return;
    }
    begin_reading(sql);
    lift_time_limit(sql);
    ConnectionPool copies(parse_database_url("sqlite:" + name), {});
    copy_to_sqlite(sql, copies.take()->sql());
    sql << "ROLLBACK";
  } catch (const soci::soci_error& error) {
    if (connection_lost(sql)) throw failure_of(error, true, url.shown).error;
    throw Error(ErrorKind::io, "cannot keep a copy of the database " + url.shown + " at " + name + ": " +
                                   one_line(error.get_error_message(), 300) +
                                   "; make room on the disk, or see that the folder can be written to");
  }
}

/// What copies of this database are named after. Databases of other servers have another name.
fs::path place_of_copies(const DatabaseUrl& url, const fs::path& folder) {
  if (!url.postgresql) return url.file;
  std::string name;
  {
    ConnectionPool pool(url, {});
    pool.take()->sql() << "SELECT current_database()", into(name);
  }
  const std::string whole = url.shown + "/" + name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c > 127 || (std::isalnum(c) == 0 && c != '-'); },
      '_');
  return folder /
         (name + "-" + to_hex(hash_bytes(std::as_bytes(std::span(whole)))).substr(0, 8) + ".postgresql");
}

/// That nobody takes an older copy for one of today.
void tell_of_earlier_copy(const fs::path& kept) {
  log::warn("the database is brought up to date, and no copy of it is kept: there is an earlier one, " +
            kept.string() + "; move it away to have a new one the next time");
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
  sql << in_dialect(sql, table_of_steps);
  std::set<int> before = done(sql);
  for (const Migration& step : migrations()) {
    if (before.erase(step.number) > 0) continue;
    run_step(sql, step);
  }
  refuse_newer(before);
}

size_t missing_migrations(const std::string& url) {
  const DatabaseUrl parsed = parse_database_url(url);
  return is_there(parsed) ? missing_steps(parsed).size() : migrations().size();
}

fs::path keep_before_migration(const std::string& url, const fs::path& folder) {
  const DatabaseUrl parsed = parse_database_url(url);
  if (!is_there(parsed)) return {};
  const std::vector<int> missing = missing_steps(parsed);
  if (missing.empty() || missing.size() == migrations().size()) return {};
  std::array<char, 8> number{};
  std::snprintf(number.data(), number.size(), "%03d", missing.front());
  fs::path kept = place_of_copies(parsed, folder).string() + ".before-" + number.data();
  std::error_code failed;
  if (fs::exists(kept, failed)) {
    tell_of_earlier_copy(kept);
    return {};
  }
  if (parsed.postgresql) make_data_folder(folder);
  AtomicFile copy(kept);
  copy_database(parsed, copy.path());
  // Another process may have run the steps meanwhile; then it has kept its own copy.
  if (missing_steps(parse_database_url("sqlite:" + copy.path().string())) != missing) return {};
  copy.commit();
  return kept;
}

}  // namespace ream::store
