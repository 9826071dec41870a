#pragma once
#include <filesystem>
#include <string>

#include "app/backup.hpp"

namespace ream::app {

/// Name of a folder of the data folder into which restoring has moved what was there begins with this.
inline constexpr const char* moved_aside = "before-restore-";

struct RestoreReport {
  std::map<std::string, size_t> counts;  ///< as of the backup
  uint64_t rows = 0;
  std::filesystem::path aside;  ///< where what was there before lies now; empty: nothing was
};

/// Errors not_found and invalid_input for what is no backup at first sight.
void require_backup(const std::filesystem::path& file);

struct RestoreOptions {
  bool force = false;
  bool keep_tokens = false;  ///< those that were revoked since the backup are good again, too
};

/// Puts a backup's folders into the data folder and its rows into the database. Both must be empty, or with
/// `force` what they hold is moved aside: folders as they are, rows as table files. All or nothing. Logins
/// and viewer links of the backup are left out, and tokens unless they are to be kept. Errors: not_found,
/// invalid_input for what is no whole backup; conflict when something is there, or a server runs on the data
/// folder; those of the database; io; what `progress` throws.
RestoreReport restore_backup(store::Database& database, const std::filesystem::path& data,
                             const std::filesystem::path& file, const RestoreOptions& options,
                             const Progress& progress = no_progress);

}  // namespace ream::app
