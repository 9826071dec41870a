#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "access/access_control.hpp"
#include "api/change_feed.hpp"
#include "api/idempotency.hpp"
#include "core/periodic_task.hpp"
#include "core/utc.hpp"
#include "jobs/job_service.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// How long this machine has been on, also while it slept.
std::chrono::nanoseconds time_since_boot();

/// How long data is kept, in days.
struct RetentionRules {
  std::optional<int> keep_sessions_days;  ///< from their creation on; none: for ever
  int keep_deleted_days = 30;             ///< 0: what is deleted is gone
  std::chrono::milliseconds look_every = std::chrono::hours(1);
  WallClock now = machine_clock();
  /// Time that nobody sets, suspension included: what the wall clock is held against.
  std::function<std::chrono::nanoseconds()> running = time_since_boot;
  /// Keeps how the wall clock went from run to run; empty: a start trusts it.
  std::filesystem::path clock_file = {};
  /// Most of the sessions, and of sessions and trash together, that may go in one look. Up to 20 always may.
  int max_at_once_percent = 50;
};

/// What the rules of retention are carried out with. All outlive Retention.
struct RetentionTools {
  session::SessionService& sessions;
  session::ReplayService& replays;
  jobs::JobService& jobs;
  Idempotency& idempotency;  ///< forgets what was answered about sessions that are erased, and what is old
  ChangeFeed& feed;
  const study::StudyService& studies;  ///< of a closed one sessions may be deleted without a person asking
  access::AuditLog& audit_log;         ///< keeps that a session was deleted or erased by the rules
};

/// Deletes old sessions, erases what was deleted long enough ago, and removes old files of jobs: when it
/// begins and from time to time, on a thread that gives way to everything else. Sessions that are live, that
/// somebody keeps for good, or that belong to a study that is not over stay.
///
/// Time decides what goes, and a clock may be wrong. So nothing is deleted or erased because of its age until
/// the server has run for a day, in all, in which the wall clock went evenly: within ten minutes of the time
/// that the machine has been on, and between two runs neither back nor ahead by more than four days. Nor when
/// more than RetentionRules::max_at_once_percent would go at once. held() says so then, and the log. What is
/// erased as nothing is to be kept is no matter of time.
class Retention {
 public:
  Retention(RetentionRules rules, RetentionTools tools);

  /// Nothing is done before.
  void begin() { task_.start(); }
  /// Something was deleted by hand. Looks at once where that is not to be kept.
  void was_deleted();
  /// Why sessions that are due are not deleted at present; empty: nothing is held back.
  std::string held() const;
  /// When a session that was deleted then is erased.
  std::string ends_utc(const std::string& deleted_utc) const;
  /// May be called twice.
  void stop() { task_.stop(); }

 private:
  void look();
  bool clock_is_even();
  void begin_with(UtcMoment wall);
  void remember(UtcMoment wall) const;
  /// Whether so many of so many may go; notes why not.
  bool may_go(size_t count, size_t of, const std::string& what);
  std::vector<session::SessionRecord> due_sessions(size_t& all);
  void delete_old_sessions();
  void delete_by_rule(const session::SessionRecord& record);
  void erase_deleted_sessions();
  void erase(const session::DeletedSession& deleted);
  void audit(const std::string& action, const std::string& session_id, const std::string& detail);
  std::string days_ago(int days) const;

  struct ClockReading {
    UtcMoment wall;
    std::chrono::nanoseconds running;
  };
  const RetentionRules rules_;
  const RetentionTools tools_;
  std::optional<ClockReading> last_reading_;
  /// For how long the clock has gone evenly, at least; trusted from a day on.
  std::chrono::nanoseconds even_;
  std::string reason_;  ///< of this look
  mutable std::mutex mutex_;
  std::string held_;
  PeriodicTask task_;
};

}  // namespace ream::api
