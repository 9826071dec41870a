#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.hpp"

namespace ream::store {

/// A file and the name it has in an archive (with '/').
struct ArchiveEntry {
  std::filesystem::path file;
  std::string name;
  int64_t bytes = -1;  ///< that it begins with, of a file that may be growing; -1: all
};

/// Writes a zip archive as a whole (temporary name, fsync, rename). Files that are compressed already are
/// stored as they are. Errors: io; what `progress` throws.
void write_zip(const std::filesystem::path& path, const std::vector<ArchiveEntry>& entries,
               const Progress& progress = no_progress);

/// Limits of what is unpacked, so that a small file cannot fill a disk.
struct UnpackLimits {
  uint64_t entries = 1000;
  uint64_t bytes = uint64_t{16} << 30;
  bool durable = true;  ///< all of them survive a loss of power once unpacked; not needed for passing ones
  bool keep_times = false;  ///< files are as old as the archive says
};

/// Names of an archive's files. Error not_found, invalid_input when it is no zip archive.
std::vector<std::string> zip_names(const std::filesystem::path& path);
/// Unpacks every file into `folder`, which exists. Checksums are checked. Error invalid_input naming the
/// archive and the entry: damaged, encrypted, a name that would leave the folder, a link, or beyond the
/// limits (the sizes that the archive states are looked at before anything is unpacked); io; cancelled by
/// `progress`.
void unpack_zip(const std::filesystem::path& path, const std::filesystem::path& folder,
                const UnpackLimits& limits = {}, const Progress& progress = no_progress);

}  // namespace ream::store
