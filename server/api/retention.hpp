#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "api/change_feed.hpp"
#include "core/utc.hpp"
#include "jobs/job_service.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"

namespace ream::api {

/// How long data is kept, in days.
struct RetentionRules {
  std::optional<int> keep_sessions_days;  ///< from their creation on; none: for ever
  int keep_deleted_days = 30;             ///< 0: what is deleted is gone
  std::chrono::milliseconds look_every = std::chrono::hours(1);
  WallClock now = machine_clock();
};

/// What the rules of retention are carried out with. All outlive Retention.
struct RetentionTools {
  session::SessionService& sessions;
  session::ReplayService& replays;
  jobs::JobService& jobs;
  ChangeFeed& feed;
  /// Whether sessions of that study may be deleted without a person asking for it.
  std::function<bool(const std::string& study_id)> is_over;
  /// Keeps that a session was deleted or erased by the rules.
  std::function<void(const std::string& action, const std::string& session_id, const std::string& detail)>
      audit;
};

/// Deletes old sessions, erases what was deleted long enough ago, and removes old files of jobs: when it
/// begins and from time to time, on a thread that gives way to everything else. Sessions that are live, that
/// somebody keeps for good, or that belong to a study that is not over stay.
class Retention {
 public:
  Retention(RetentionRules rules, RetentionTools tools);
  ~Retention();
  Retention(const Retention&) = delete;
  Retention& operator=(const Retention&) = delete;

  /// Nothing is done before.
  void begin();
  /// Something was deleted by hand. Looks at once where that is not to be kept.
  void was_deleted();
  /// When a session that was deleted then is erased.
  std::string ends_utc(const std::string& deleted_utc) const;
  /// May be called twice.
  void stop();

 private:
  void work();
  void look();
  void delete_old_sessions();
  void delete_by_rule(const session::SessionRecord& record);
  void erase_deleted_sessions();
  std::string days_ago(int days) const;
  bool stopping();

  const RetentionRules rules_;
  const RetentionTools tools_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false, look_wanted_ = true;
  std::thread thread_;
};

}  // namespace ream::api
