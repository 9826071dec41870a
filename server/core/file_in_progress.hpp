#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace ream {

/// A file of any size under construction, written at any place of it to a temporary name beside its final
/// one, which only commit() gives it. Destroyed uncommitted, it goes away, so nothing half-written is ever
/// seen.
class FileInProgress {
 public:
  /// Throws Error io naming the final path.
  explicit FileInProgress(std::filesystem::path final_path);
  ~FileInProgress();
  FileInProgress(const FileInProgress&) = delete;
  FileInProgress& operator=(const FileInProgress&) = delete;

  /// Where it is meanwhile.
  const std::filesystem::path& path() const { return temporary_; }
  /// Thread-safe. The disk begins at once, so that commit() has little to wait for. Throws Error io.
  void write_at(uint64_t offset, std::span<const std::byte> bytes) const;
  /// What was written is on the disk from here on; commit() only renames then. Throws Error io.
  void finish();
  /// finish(), and the final name. Throws Error io.
  void commit();

 private:
  [[noreturn]] void fail() const;

  const std::filesystem::path final_;
  std::filesystem::path temporary_;
  int fd_ = -1;
  bool finished_ = false, committed_ = false;
};

}  // namespace ream
