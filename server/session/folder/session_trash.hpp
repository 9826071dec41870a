#pragma once
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "session/folder/session_folder.hpp"

namespace ream::session {

/// A session that was deleted and can still be had back.
struct DeletedSession {
  std::string id;
  std::string deleted_utc;
  std::optional<SessionRecord> record;  ///< none: its files cannot be read
};

/// Folders of deleted sessions, in a folder "trash" beside that of the sessions. A session is moved by one
/// rename, so that it is in one place or the other whatever happens meanwhile. Thread-safe.
class SessionTrash {
 public:
  /// Takes away what was being erased when an earlier server ended. `sessions_folder` empty: there is none.
  explicit SessionTrash(const std::filesystem::path& sessions_folder);

  /// Moves the session's folder here. Errors: conflict while somebody uses it, or another one of that id lies
  /// here; not_found without such a folder; io.
  void take(const std::string& id);
  /// Moves it back. Errors: not_found; conflict when there is a session of that id again; io.
  void give_back(const std::string& id);
  /// Removes it for good. Harmless when it is not here. Error io.
  void erase(const std::string& id);

  bool has(const std::string& id) const;
  /// All of them, lately deleted ones first.
  std::vector<DeletedSession> list() const;

 private:
  std::filesystem::path folder_of(const std::string& id) const { return folder_ / id; }

  const std::filesystem::path sessions_, folder_;
  std::mutex changing_;
};

}  // namespace ream::session
