#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/progress.hpp"
#include "core/utc.hpp"
#include "jobs/job_record.hpp"

namespace ream::jobs {

struct JobOptions {
  /// Where files lie that work makes for its clients, each in a folder of its job's; what an earlier server
  /// left there is removed. Empty: work makes none.
  std::filesystem::path folder = {};
  std::chrono::seconds results_kept = std::chrono::hours(24);
  size_t max_kept = 256;  ///< ended jobs that can be asked about
  /// Told of every change, from the thread that makes it; must not wait.
  std::function<void(const JobRecord&)> on_change = {};
  WallClock now = machine_clock();
  size_t of_caller = 4;  ///< jobs of one trainee that wait or run
};

/// Does long work one after the other, on a thread that gives way to everything else (a running haptic loop
/// above all). Thread-safe; unknown ids throw Error not_found.
class JobService {
 public:
  using Work = std::function<void(const Progress& progress)>;
  /// Work that makes a file: in `folder`, which is empty; returns the file's name and media type.
  struct MadeFile {
    std::string name, media_type;
  };
  using FileWork = std::function<MadeFile(const std::filesystem::path& folder, const Progress& progress)>;

  explicit JobService(JobOptions options = {});
  /// Cancels what runs and waits for it.
  ~JobService();
  JobService(const JobService&) = delete;
  JobService& operator=(const JobService&) = delete;

  /// Error conflict while other work on that case waits or runs; unavailable when too much waits, of all or
  /// of whom the order is counted for.
  JobRecord submit(const JobOrder& order, Work work);
  JobRecord submit_file(const JobOrder& order, FileWork work);
  /// Work of that kind on that session that waits or runs; none otherwise.
  std::optional<JobRecord> open_on_session(const std::string& kind, const std::string& session_id) const;

  JobRecord get(const std::string& id) const;
  /// Newest first.
  std::vector<JobRecord> list() const;
  /// Asks it to end at its next step. Harmless when it has ended.
  JobRecord cancel(const std::string& id);
  /// Whether work on that case waits or runs.
  bool busy(const std::string& case_id) const;
  /// Removes files that were kept long enough; their jobs stay.
  void remove_old_results();
  /// Cancels everything; nothing can be submitted any more. May be called twice.
  void shut_down();

 private:
  struct Job;
  JobRecord add(const JobOrder& order, const std::shared_ptr<Job>& job);
  void work();
  void run(const std::shared_ptr<Job>& job);
  void note_progress(Job& job, double share, std::string_view step);
  void end(Job& job, JobState state, ErrorKind kind, const std::string& problem);
  void notify(const JobRecord& record) const;
  std::filesystem::path folder_of(const Job& job) const;
  void forget_surplus();
  std::shared_ptr<Job> find(const std::string& id) const;
  bool busy_locked(const std::string& case_id) const;

  const JobOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Job>> jobs_;  ///< oldest first
  uint64_t submitted_ = 0;
  bool closed_ = false;
  std::thread thread_;
};

}  // namespace ream::jobs
