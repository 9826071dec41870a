#pragma once
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ream {

/// Threads that work on numbered pieces together with the thread that asks; kept from one job to the next.
class Crew {
 public:
  /// `threads` with the asking one; 0: as many as the machine has processors.
  explicit Crew(int threads = 0);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }

  /// Jobs come from one thread at a time. Calls work(piece, worker) for all pieces below count, worker from 0
  /// to threads() - 1, and returns when all are done. `told` hears from the asking thread how far it is. The
  /// first exception of `work` or `told` ends the job early and is thrown here. Pieces are taken in order and
  /// one that was taken is worked on, so that work may wait for those below it.
  void run(size_t count, const std::function<void(size_t piece, int worker)>& work,
           const std::function<void(double share)>& told = {});

 private:
  struct Job {
    size_t count = 0;
    const std::function<void(size_t, int)>* work = nullptr;
    const std::function<void(double)>* told = nullptr;
  };
  void help(int worker);
  void send_home();
  void take_pieces(int worker);

  std::mutex mutex_;
  std::condition_variable start_, done_;
  Job job_;
  std::atomic<size_t> number_of_job_{0};
  std::atomic<bool> ends_{false};
  int busy_ = 0;
  std::exception_ptr failure_;
  std::atomic<size_t> next_{0};
  std::vector<std::thread> helpers_;
};

}  // namespace ream
