#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "store/database.hpp"

namespace ream::app {

/// A backup is a zip archive: backup.json says what it is, tables/ has the database's tables in a form that
/// suits every kind of database, data/ the folders of the data folder.

struct BackupReport {
  std::map<std::string, size_t> counts;  ///< of sessions, cases and what else there is, by folder
  uint64_t rows = 0;                     ///< of all tables
  std::vector<std::string> live;         ///< sessions that were live: kept as far as they had come
};

/// Writes one while a server may run. The file appears as a whole or not at all, and only its owner may read
/// it. Errors: those of the database; io; what `progress` throws.
BackupReport write_backup(store::Database& database, const std::filesystem::path& data,
                          const std::filesystem::path& file, const Progress& progress = no_progress);

}  // namespace ream::app
