#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

/// One step of the tables' history: server/store/migrations/NNN_words.sql. Steps run once each, in order of
/// their numbers, and never change once released. They are written in SQL that both stores understand, with
/// the types TEXT (sorted by bytes on both), BIGINT and DOUBLE PRECISION, and NUMBERED_KEY for a column that
/// numbers its rows by itself. Statements end with ';' at the end of a line.
struct Migration {
  int number;
  std::string name, statements;
};

/// All of this build, by number.
const std::vector<Migration>& migrations();

/// Names of the tables that they make, each behind those that it refers to.
std::vector<std::string> table_names();

/// Runs those that are missing, inside the caller's transaction. Error conflict when the database knows steps
/// that this build does not.
void migrate(Sql& sql);

/// How many steps of this build the database at `url` has not run. It is made ready by opening it
/// (store::Database); this changes no table, and makes no database. Errors: those of opening it, and conflict
/// when a newer build has changed its tables.
size_t missing_migrations(const std::string& url);

/// To be called before an older database is opened, which changes its tables: a copy is kept with which the
/// older version can go on, a SQLite file named after the first step that is missing. Of a SQLite file it
/// lies beside it, `<file>.before-NNN`; of PostgreSQL in `folder`, which is made,
/// `<name>-<hash of its address>.postgresql.before-NNN`. Returns the copy's path; empty where none was made,
/// as the database is new or up to date, or a copy is there already, which is logged. Errors: those of
/// missing_migrations(); io.
std::filesystem::path keep_before_migration(const std::string& url, const std::filesystem::path& folder);

}  // namespace ream::store
