#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ream {

/// Whole file as text or bytes. Throws Error: not_found when there is no such file, io when it cannot be
/// read.
std::string read_text_file(const std::filesystem::path& path);
std::vector<std::byte> read_binary_file(const std::filesystem::path& path);

/// Replaces `path` as a whole: written to a temporary name beside it, fsynced, renamed. On any failure the
/// old file is untouched and no temporary is left. Throws Error io naming the path.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// Parsed JSON; Error invalid_input names the file and the place of a syntax error.
nlohmann::json read_json_file(const std::filesystem::path& path);

/// Names that were made in the folder survive a loss of power from here on, where the file system can promise
/// it.
void sync_folder(const std::filesystem::path& folder);

/// Creates `path` and its parents and proves that a file can be written there. Throws Error io.
void make_writable_folder(const std::filesystem::path& path);

/// A folder under construction: everything is written to a sibling temporary, and `commit` moves it to its
/// final name. Destroyed uncommitted, it removes itself, so nothing half-written is ever seen.
class FolderInProgress {
 public:
  /// `final_path` must not exist, or be an empty folder, or `replace` is set. Throws Error io or conflict.
  explicit FolderInProgress(std::filesystem::path final_path, bool replace = false);
  ~FolderInProgress();
  FolderInProgress(const FolderInProgress&) = delete;
  FolderInProgress& operator=(const FolderInProgress&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path final_, temporary_;
  std::vector<std::filesystem::path> made_parents_;  ///< innermost first
  bool committed_ = false;
};

}  // namespace ream
