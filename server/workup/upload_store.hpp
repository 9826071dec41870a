#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace ream::workup {

/// A file on its way here, in pieces.
struct Upload {
  std::string id, name;  ///< name: what the sender calls the file, for its extension and for people
  uint64_t bytes = 0;    ///< whole size, as announced
  uint64_t received = 0;
  std::string owner = {};  ///< user who sends it; empty without users
};

inline constexpr size_t max_upload_name = 200;

struct UploadLimits {
  uint64_t file_bytes = uint64_t{8} << 30;  ///< one file
  uint64_t all_bytes = uint64_t{32} << 30;  ///< what all uploads together announce
  size_t count = 64;
  std::chrono::minutes idle{24 *
                            60};  ///< what nobody goes on with for so long may be patients' data left behind
};

/// Files that clients send in pieces, each kept as <folder>/<id>/<name>, so that memory stays bounded and a
/// broken connection goes on where it ended. Thread-safe; unknown ids throw Error not_found. What an earlier
/// server left there is removed at the start.
class UploadStore {
 public:
  explicit UploadStore(std::filesystem::path folder, UploadLimits limits = {});

  /// `name` must be a plain file name with an extension that a CT may have. Errors: invalid_input;
  /// RequestError 413 beyond the limits; io.
  Upload create(const std::string& name, uint64_t bytes, const std::string& owner = {});
  Upload get(const std::string& id) const;
  std::vector<Upload> list() const;
  /// Appends a piece at `offset`. Errors: conflict when that is not where the file ends so far or when the
  /// piece goes beyond the announced size; io.
  Upload append(const std::string& id, uint64_t offset, std::string_view piece);
  /// Errors: conflict while the file is in use.
  void remove(const std::string& id);

  /// The whole file, for good: the id is forgotten and the caller owns what is left of the folder that holds
  /// the file. Error conflict when it is not complete.
  std::filesystem::path take(const std::string& id);

  using Clock = std::chrono::steady_clock;
  /// Removes those that nobody has gone on with for UploadLimits::idle.
  void remove_idle(Clock::time_point now = Clock::now());

 private:
  struct Entry {
    Upload upload;
    Clock::time_point used;
  };
  Entry& find(const std::string& id);
  std::filesystem::path file_of(const Upload& upload) const;

  const std::filesystem::path folder_;
  const UploadLimits limits_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry> uploads_;
};

}  // namespace ream::workup
