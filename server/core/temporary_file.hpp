#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/file_lock.hpp"

namespace ream {

/// Removes a file, or a folder with all that lies below it, however deep and whatever its permissions are;
/// links are removed, not followed. Holds two descriptors at most, where std::filesystem::remove_all has one
/// for each level open. Nobody else may change the folder meanwhile. False when something is left; what was
/// not there is gone, too.
bool remove_tree(const std::filesystem::path& path) noexcept;

/// A name for a file that goes when this does; what has been opened stays readable.
class TemporaryFile {
 public:
  /// A name of its own in `folder` (empty: the system's for temporary files), ending in `ending` (".csv").
  /// Makes the folder, not the file.
  TemporaryFile(const std::filesystem::path& folder, const std::string& ending);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A new folder, beside others and named after `beside`, that goes with its contents when this does.
class TemporaryFolder {
 public:
  /// Throws Error io naming `beside`.
  explicit TemporaryFolder(const std::filesystem::path& beside);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::optional<FileLock> lock_;  ///< says that its owner lives (leftovers.hpp)
};

}  // namespace ream
