#pragma once
#include <filesystem>
#include <optional>

#include "core/file_descriptor.hpp"

namespace ream {

/// Holds a lock file for as long as it lives. The system lets go of it when the process ends, however it
/// ends; the file itself stays. Works between processes and within one.
class FileLock {
 public:
  /// Makes the file if need be. Empty when somebody else holds it, and still does 0.1 s later, or moves it
  /// away. Throws Error io.
  static std::optional<FileLock> attempt(const std::filesystem::path& path);
  /// Of a file or folder that is there. Empty when somebody else holds it, it is gone, or the file system has
  /// no locks.
  static std::optional<FileLock> attempt_existing(const std::filesystem::path& path);
  /// Whether somebody holds it; false without such a file. Makes nothing.
  static bool held(const std::filesystem::path& path);

 private:
  explicit FileLock(FileDescriptor file) : file_(std::move(file)) {}
  FileDescriptor file_;
};

}  // namespace ream
