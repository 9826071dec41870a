#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "session/folder/session_folder.hpp"

namespace ream::session {

/// All sessions that lie in a data folder, whoever ran them. What was read once is read again only when its
/// session.json has been replaced, so that a list of thousands costs a look at each. Thread-safe.
class SessionArchive {
 public:
  /// `folder` holds one folder a session; it may be missing.
  explicit SessionArchive(std::filesystem::path folder);

  /// Names of all folders that may hold one, in no order.
  std::vector<std::string> ids() const;
  /// Newest first. Folders that are damaged are left out, and warned about once each.
  std::vector<SessionRecord> list() const;
  /// Empty when there is no such folder, or no session.json in it. Error invalid_input or io when it is
  /// damaged.
  std::optional<SessionRecord> find(const std::string& id) const;
  /// What metrics.json holds. Error not_found when there is no such session or it left none.
  nlohmann::json metrics(const std::string& id) const;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path folder_of(const std::string& id) const { return folder_ / id; }

 private:
  struct Known {
    int64_t stamp = 0;  ///< of session.json, see session_stamp()
    std::optional<SessionRecord> record;
    std::string damage;
  };
  Known look(const std::filesystem::path& folder) const;

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Known> known_;  ///< by id
};

}  // namespace ream::session
