#pragma once
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "core/progress.hpp"

namespace ream {

/// Threads that work on numbered pieces together with the thread that asks; kept from one job to the next.
class ThreadPool {
 public:
  /// `threads` with the asking one; 0: as many as the machine has processors.
  explicit ThreadPool(int threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Jobs come from one thread at a time. Calls work(piece, worker) for all pieces below count, worker from 0
  /// to threads() - 1, and returns when all are done. `progress` is called on the asking thread with the
  /// share that has been begun. The first exception of `work` or `progress` ends the job early and is thrown
  /// here. Pieces are taken in order and one that was taken is worked on, so that work may wait for those
  /// below it.
  void run(size_t count, const std::function<void(size_t piece, int worker)>& work,
           const std::function<void(double share)>& progress = {});

 private:
  struct Job {
    size_t count = 0;
    const std::function<void(size_t, int)>* work = nullptr;
    const std::function<void(double)>* progress = nullptr;
  };
  void work_on_jobs(int worker);
  void take_pieces(int worker);
  void stop();

  std::mutex mutex_;
  std::condition_variable start_, done_;
  Job job_;
  std::atomic<size_t> job_number_{0};
  std::atomic<bool> stopping_{false};
  int busy_ = 0;
  std::exception_ptr failure_;
  std::atomic<size_t> next_{0};
  std::vector<std::thread> workers_;
};

/// ThreadPool::run() for one job on up to `threads` threads, which `progress` follows as `step`; with an
/// empty `step` it is not called before the first piece.
void parallel_for(int threads, size_t count, const std::function<void(size_t)>& work,
                  const Progress& progress = no_progress, std::string_view step = {});

/// From here on the calling thread takes no processor from a haptic loop or a viewer's stream.
void lower_thread_priority();

}  // namespace ream
