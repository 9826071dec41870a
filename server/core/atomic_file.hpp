#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/file_lock.hpp"

namespace ream {

/// A file under construction, written to a temporary name beside its final one (ending in .tmp), which only
/// commit() gives it. Destroyed uncommitted, it goes away, so nothing half-written is ever seen. Written
/// either at any place by write_at(), or piece by piece from its beginning by write().
class AtomicFile {
 public:
  /// Throws Error io naming the final path, also where a folder, a device or a pipe has that name.
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where it is meanwhile.
  const std::filesystem::path& path() const { return temporary_; }
  /// Thread-safe. The disk begins at once, so that commit() has little to wait for. Throws Error io naming
  /// the final path and the cause (a full disk, say).
  void write_at(uint64_t offset, std::span<const std::byte> bytes) const;

  /// Behind what write() wrote before; collected in memory and passed on 1 MB at a time. Throws Error io.
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
  /// A value as it lies in memory.
  template <class T>
  void write_value(const T& value) {
    write(std::as_bytes(std::span(&value, 1)));
  }

  /// What was written is on the disk from here on; commit() only renames then. For several files that are to
  /// change together or not at all. Throws Error io.
  void finish();
  /// finish(), and the final name. Throws Error io.
  void commit();

 private:
  [[noreturn]] void fail() const;
  void flush();

  const std::filesystem::path final_;
  std::filesystem::path temporary_;
  int fd_ = -1;
  uint64_t flushed_bytes_ = 0;
  std::vector<std::byte> waiting_;
  bool finished_ = false, committed_ = false;
};

/// A folder under construction: everything is written to a sibling temporary, and `commit` moves it to its
/// final name. Destroyed uncommitted, it removes itself, so nothing half-written is ever seen.
class AtomicFolder {
 public:
  /// `final_path` must not exist, or be an empty folder, or `replace` is set. Throws Error io or conflict.
  explicit AtomicFolder(std::filesystem::path final_path, bool replace = false);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path final_, temporary_;
  std::optional<FileLock> lock_;                     ///< says that its owner lives (leftovers.hpp)
  std::vector<std::filesystem::path> made_parents_;  ///< innermost first
  bool committed_ = false;
};

/// Error io where a folder, a device or a pipe has this name: a file takes the place of files only.
void require_replaceable(const std::filesystem::path& path);

}  // namespace ream
