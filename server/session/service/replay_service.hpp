#pragma once
#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "core/periodic_task.hpp"
#include "session/running_replay.hpp"
#include "session/service/session_engine.hpp"

namespace ream::session {

struct ReplayLimits {
  size_t open = 4;       ///< at once
  size_t of_caller = 2;  ///< of those, one trainee's or viewer's
  /// A replay that for so long nobody has watched or asked about ends by itself.
  std::chrono::milliseconds unattended = std::chrono::minutes(15);
  std::chrono::milliseconds look_every = std::chrono::seconds(30);  ///< for such replays
};

/// A replay as others see it.
struct ReplayRecord {
  ReplayRequest request;
  std::string created_utc;
  bool open = true;
  PlaybackStatus status;
  std::vector<ReplayMark> marks;
};

/// Owns the replays of this server. Thread-safe. Unknown ids throw Error not_found.
class ReplayService {
 public:
  /// `engine` outlives it.
  ReplayService(SessionEngine& engine, ReplayLimits limits);
  ~ReplayService() { shut_down(); }
  ReplayService(const ReplayService&) = delete;
  ReplayService& operator=(const ReplayService&) = delete;

  /// `wanted.id` is chosen here. When as many are open as may be, the one that has gone unwatched for longest
  /// is ended, of the caller's own when these are as many as one may have. Errors: conflict when all those
  /// are watched; unavailable when all are; those of the engine.
  ReplayRecord create(ReplayRequest wanted);
  bool has(const std::string& id) const;
  /// Newest first.
  std::vector<ReplayRecord> list() const;
  ReplayRecord get(const std::string& id) const;
  ReplayRecord change(const std::string& id, const PlaybackChange& change);
  /// Ends it; it is then unknown.
  ReplayRecord stop(const std::string& id);
  /// Ends all of one session.
  void stop_all_of(const std::string& session_id);
  nlohmann::json metrics(const std::string& id) const;
  /// The replay lives on as long as somebody watches it.
  std::unique_ptr<net::WebSocketSession> subscribe(const std::string& id, int stride) const;

  /// Ends all; none can be created any more.
  void shut_down();

 private:
  struct Entry;
  using Entries = std::vector<std::shared_ptr<Entry>>;
  std::shared_ptr<Entry> find(const std::string& id) const;
  std::shared_ptr<Entry> reserve_place(const std::string& caller);
  void free_place(const std::string& caller) { being_made_.erase(being_made_.find(caller)); }
  void end_unattended();
  Entries take_unattended();

  SessionEngine& engine_;
  const ReplayLimits limits_;
  mutable std::mutex mutex_;
  Entries entries_;                        ///< oldest first
  std::multiset<std::string> being_made_;  ///< for whom
  bool closed_ = false;
  PeriodicTask cleanup_;  ///< ends unattended replays
};

}  // namespace ream::session
