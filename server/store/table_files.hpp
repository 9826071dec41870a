#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "store/database.hpp"

namespace ream::store {

/// The tables of a database as files that do not depend on the kind of database: <table>.jsonl, the names of
/// the columns as an array in the first line, then a row a line.

struct TableFile {
  std::string table;
  uint64_t rows = 0;
};

/// Writes all tables as they are at one moment into `folder`, rows sorted. Errors: those of Database; io.
std::vector<TableFile> write_table_files(Database& database, const std::filesystem::path& folder);

/// Replaces what the tables of `to` hold by the rows of `from`, which has the same tables. Within the
/// caller's transactions.
void copy_tables(Sql& from, Sql& to);

/// Tables that hold anything.
std::vector<std::string> filled_tables(Database& database);

/// Which logins, links and tokens of a file are good again. Some may have been revoked since it was written.
enum class OldCredentials { all, tokens, none };

/// Replaces what the tables hold by these files of `folder`, all or nothing. `before_commit` is called when
/// all of it has gone well and may still throw; it may be called more than once. Errors: those of Database;
/// invalid_input naming file and line for what is no such file, or not the stated number of rows.
void read_table_files(Database& database, const std::filesystem::path& folder,
                      const std::vector<TableFile>& files, const std::function<void()>& before_commit,
                      const Progress& progress = no_progress,
                      OldCredentials credentials = OldCredentials::all);

}  // namespace ream::store
