#pragma once
#include <filesystem>
#include <string_view>

namespace ream {

/// The new contents of a file, written and fsynced under a name beside it that ends in .tmp: commit() only
/// renames. For several files that are to change together or not at all. Destroyed uncommitted, it goes away.
class StagedFile {
 public:
  /// Throws Error io naming `path`.
  StagedFile(std::filesystem::path path, std::string_view text);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  void commit();

 private:
  const std::filesystem::path path_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

}  // namespace ream
