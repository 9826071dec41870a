#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "store/table_files.hpp"

namespace ream::app {

/// backup.json.
struct BackupManifest {
  std::string made_utc, build;
  std::vector<store::TableFile> tables;
  uint64_t files = 0;  ///< below data/
};

/// With the steps of the tables' history that this build has.
void write_manifest(const BackupManifest& manifest, const std::filesystem::path& file);

/// Error invalid_input, naming `archive`, for a file that says it is something else or from a newer build.
BackupManifest read_manifest(const std::filesystem::path& file, const std::filesystem::path& archive);

}  // namespace ream::app
