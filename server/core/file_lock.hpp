#pragma once
#include <filesystem>
#include <optional>

namespace ream {

/// Holds a lock file for as long as it lives. The system lets go of it when the process ends, however it
/// ends; the file itself stays. Works between processes and within one.
class FileLock {
 public:
  /// Makes the file if need be. Empty when somebody else holds it. Throws Error io.
  static std::optional<FileLock> attempt(const std::filesystem::path& path);
  /// Whether somebody holds it; false without such a file. Makes nothing.
  static bool held(const std::filesystem::path& path);

  ~FileLock();
  FileLock(FileLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  FileLock& operator=(FileLock&& other) noexcept;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace ream
