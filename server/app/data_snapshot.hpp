#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "store/zip_archive.hpp"

namespace ream::app {

/// Folders of a data folder that a backup keeps: all but uploads, what a restore has moved aside, and what is
/// under construction. Files beside them (a database) are none of them. Names only, sorted.
std::vector<std::string> kept_folders(const std::filesystem::path& data);

/// What lies in these folders, held fast while the server goes on.
struct DataSnapshot {
  std::vector<store::ArchiveEntry> files;  ///< named "<folder>/<session>/<file>"
  std::map<std::string, size_t> counts;    ///< of sessions, cases and what else there is, by folder
  std::vector<std::string> live;           ///< sessions that were live: kept as far as they had come
};

/// Links every file (copies it where the file system cannot) into `into`, each session and case as it was at
/// one moment: files that are replaced later stay what they were, and of recordings that go on only what
/// there was is named. `into` exists, and outlives the use of the files. Error io.
DataSnapshot snapshot_data(const std::filesystem::path& data, const std::filesystem::path& into);

}  // namespace ream::app
