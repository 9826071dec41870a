#pragma once
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "session/folder/session_archive.hpp"
#include "store/session_index.hpp"

namespace ream::session {

/// Makes the index of sessions follow their folders, on a thread of its own: at first whatever is new,
/// changed or gone since the last time, then what it is told of. While the database is away it waits and
/// catches up later; nobody else does. Thread-safe.
class IndexUpkeep {
 public:
  /// Both outlive it.
  IndexUpkeep(const SessionArchive& archive, store::Database& database);
  /// Writes what is waiting, unless the database is away.
  ~IndexUpkeep();
  IndexUpkeep(const IndexUpkeep&) = delete;
  IndexUpkeep& operator=(const IndexUpkeep&) = delete;

  /// Something of this session's folder is new, or it is gone.
  void changed(const std::string& id);

  /// Sessions whose rows are not, or may not be, what their folders say. Waits while there are many of them:
  /// Error unavailable, or what keeps them from being written, when that takes long.
  std::vector<std::string> behind();

 private:
  using Lock = std::unique_lock<std::mutex>;

  void work();
  void compare_all();
  void compare_names();
  void compare_unsettled();
  void write_some(Lock& lock);
  void know(const std::string& id, int64_t stamp, bool lasting);
  void forget_or_watch(const std::string& id);
  bool wait_for_work(Lock& lock);
  void note_failure(const Error& failure);

  const SessionArchive& archive_;
  store::SessionIndex index_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool compared_ = false, stopping_ = false;
  std::map<std::string, store::SessionIndex::Mark> known_;  ///< what was read of each folder last
  std::map<std::string, uint64_t> waiting_;  ///< to be written; the number tells whether it changed again
  std::set<std::string> unsettled_;          ///< of known_: left live, or without a row
  uint64_t changes_ = 0;
  int64_t names_stamp_ = 0;       ///< of the folder when its names were compared
  std::optional<Error> failure_;  ///< of the last attempt to write
  std::thread thread_;
};

/// Makes all rows anew from the folders. Returns how many there are. Errors are those of the database.
size_t rebuild_index(const SessionArchive& archive, store::Database& database);

}  // namespace ream::session
