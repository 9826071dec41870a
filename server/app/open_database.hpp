#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "access/audit_log.hpp"
#include "store/database.hpp"

namespace ream::app {

/// URL of the database of a data folder: `chosen` (--db) if not empty, else REAM_DB, else a SQLite file in
/// the folder. Error usage for a password on the command line, where everybody on the machine can read it.
std::string database_url(const std::string& chosen, const std::filesystem::path& data);

/// Opens it. An older one is copied first (store::keep_before_migration). The data folder is made if the
/// database or the copy lies there. Errors are those of store::Database, too.
std::shared_ptr<store::Database> open_database(const std::string& chosen, const std::filesystem::path& data);

/// Whoever may run commands on the data folder, as the audit log has them.
access::Actor command_line_actor();

/// Whether people have to log in. Makes nothing where there is no database yet. Errors as open_database().
bool has_users(const std::string& chosen, const std::filesystem::path& data);

/// Notes in the audit log that a command reads what `names` mean: ids, folders or files. Only what lies in
/// the data folder is noted, and only where people have to log in; one row for each session or case. To be
/// called before the reading, as what cannot be noted must not be read. Errors as open_database().
void note_reading(const std::string& chosen, const std::filesystem::path& data, const std::string& action,
                  const std::vector<std::string>& names);

}  // namespace ream::app
