#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace ream {

/// A file too large to be put together in memory: written piece by piece under a name beside it that ends in
/// .tmp, fsynced and renamed by commit(). Destroyed uncommitted, it goes away and the old file is untouched.
class StreamedFile {
 public:
  /// Throws Error io naming `path` when it cannot be written there.
  explicit StreamedFile(std::filesystem::path path);
  ~StreamedFile();
  StreamedFile(const StreamedFile&) = delete;
  StreamedFile& operator=(const StreamedFile&) = delete;

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

  const std::filesystem::path path_, temporary_;
  std::vector<std::byte> waiting_;
  int file_ = -1;
  bool committed_ = false;
};

}  // namespace ream
