#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/file_in_progress.hpp"

namespace ream {

/// A file too large to be put together in memory, written piece by piece from its beginning; otherwise as
/// FileInProgress.
class StreamedFile {
 public:
  /// Throws Error io naming `path` when it cannot be written there.
  explicit StreamedFile(std::filesystem::path path);
  /// Throws Error io naming the path and the cause (a full disk, say).
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
  /// A value as it lies in memory.
  template <class T>
  void write_value(const T& value) {
    write(std::as_bytes(std::span(&value, 1)));
  }
  /// Everything that was written is on the disk from here on; commit() only renames then.
  void finish();
  void commit();

 private:
  void flush();

  FileInProgress file_;
  uint64_t written_bytes_ = 0;
  std::vector<std::byte> waiting_;
};

}  // namespace ream
