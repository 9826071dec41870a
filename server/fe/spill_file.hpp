#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace ream::fe {

/// A passing file without a name: it goes away with this object or with the process, whatever ends it.
/// Thread-safe. Errors are Error io that name the folder.
class SpillFile {
 public:
  explicit SpillFile(const std::filesystem::path& folder);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  /// All of `bytes` must have been written.
  void read_at(uint64_t offset, std::span<std::byte> bytes) const;

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path folder_;
  int fd_ = -1;
};

}  // namespace ream::fe
