#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "core/file_descriptor.hpp"

namespace ream {

/// How much memory some work may take, and where goes what does not fit. Large things ask before they are
/// made.
class MemoryBudget {
 public:
  /// No limit.
  MemoryBudget() = default;
  /// `limit_bytes` of the whole process; `folder` for temporary files without a name, which go away with the
  /// process whatever ends it.
  MemoryBudget(uint64_t limit_bytes, std::filesystem::path folder);
  /// So that `left_bytes` are left, as in a process that takes over a part of another's work.
  static MemoryBudget with_left(uint64_t left_bytes, std::filesystem::path folder);

  /// What is left; never below what a few buffers take.
  uint64_t left() const;
  bool fits(uint64_t bytes) const { return bytes <= left(); }
  /// For what cannot lie on the disk. Throws Error invalid_input that names `what` and the limit it needs.
  void take(uint64_t bytes, const std::string& what);
  void give_back(uint64_t bytes);
  const std::filesystem::path& folder() const { return folder_; }

 private:
  uint64_t limit_ = UINT64_MAX, used_ = 0;
  std::filesystem::path folder_;
};

/// A temporary file without a name: it goes away with this object or with the process, whatever ends it.
/// Thread-safe. Errors are Error io that name the folder.
class SpillFile {
 public:
  explicit SpillFile(const std::filesystem::path& folder);

  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  /// All of `bytes` must have been written.
  void read_at(uint64_t offset, std::span<std::byte> bytes) const;

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path folder_;
  FileDescriptor file_;
};

}  // namespace ream
