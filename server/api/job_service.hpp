#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/progress.hpp"

namespace ream::api {

enum class JobState { waiting, running, done, failed, cancelled };
std::string to_text(JobState state);

/// Long work on a case, as clients see it.
struct JobRecord {
  std::string id, kind, case_id;
  JobState state = JobState::waiting;
  double share = 0.0;  ///< how far it is, 0 to 1
  std::string step;    ///< what it does now, for people
  ErrorKind problem_kind = ErrorKind::io;
  std::string problem;  ///< why it failed; else empty
};

/// Does long work one after the other, on a thread that gives way to everything else (a running haptic loop
/// above all). The newest 64 finished jobs can be asked about. Thread-safe; unknown ids throw Error
/// not_found.
class JobService {
 public:
  using Work = std::function<void(const Progress& progress)>;

  JobService();
  /// Cancels what runs and waits for it.
  ~JobService();
  JobService(const JobService&) = delete;
  JobService& operator=(const JobService&) = delete;

  /// Error conflict while other work on that case waits or runs; unavailable when too much waits.
  JobRecord submit(const std::string& kind, const std::string& case_id, Work work);
  JobRecord get(const std::string& id) const;
  /// Newest first; `case_id` empty: of all cases.
  std::vector<JobRecord> list(const std::string& case_id) const;
  /// Asks it to end at its next step. Harmless when it has ended.
  JobRecord cancel(const std::string& id);
  /// Whether work on that case waits or runs.
  bool busy(const std::string& case_id) const;
  /// Cancels everything; nothing can be submitted any more. May be called twice.
  void shut_down();

 private:
  struct Job;
  void work();
  void run(const std::shared_ptr<Job>& job);
  void end(Job& job, JobState state, ErrorKind kind, const std::string& problem);
  std::shared_ptr<Job> find(const std::string& id) const;
  bool busy_locked(const std::string& case_id) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> jobs_;  ///< oldest first
  bool closed_ = false;
  std::thread thread_;
};

}  // namespace ream::api
