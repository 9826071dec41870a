#pragma once
#include <array>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace ream::net {

/// What a job may have to wait for. Threads are kept for all but the last, so that jobs further down, however
/// slow or many, hold up none above.
enum class Urgency {
  health,  ///< whether the server is well: waits for nothing
  halt,    ///< what stops or pauses a session: waits for that session at most
  entry,   ///< logins: short, but anybody can send them
  usual,
};

/// A few threads for jobs that may block, with a bounded queue for each urgency.
class WorkerPool {
 public:
  enum class Taken { yes, full, caller_full };

  /// `threads` take every job, the most urgent first. `reserve`: one more for each urgency but
  /// the last, which takes what is that urgent or more. `max_waiting`: jobs of one urgency; `max_of_caller`:
  /// those of one caller among them.
  WorkerPool(size_t threads, size_t max_waiting, size_t max_of_caller = SIZE_MAX, bool reserve = false);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// `full` also when the pool has stopped: unless it is taken, the job will not run. What it throws is
  /// logged, and what it holds is let go of.
  Taken submit(std::function<void()> job, Urgency urgency = Urgency::usual, const std::string& caller = {});

  /// Waits for the jobs that run; those still waiting are dropped. May be called twice.
  void stop();

 private:
  struct Job {
    std::function<void()> run;
    std::string caller;
  };
  struct Lane {
    std::deque<Job> waiting;
    std::map<std::string, size_t> of_callers;  ///< how many wait
  };
  void work(Urgency least);
  Lane* next_lane(Urgency least);

  const size_t max_waiting_, max_of_caller_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Lane, 4> lanes_;  ///< by Urgency
  bool stopped_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace ream::net
