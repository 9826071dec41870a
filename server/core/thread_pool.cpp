#include "core/thread_pool.hpp"

#include <sched.h>

#include <algorithm>

#include "core/signal_handlers.hpp"

namespace ream {
namespace {

/// About 0.1 ms: a job often follows the one before at once, and waking a thread takes half of that.
constexpr int turns_before_sleep = 5000;

inline void pause_processor() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

ThreadPool::ThreadPool(int threads) {
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  // A thread that finds no place in the vector would end the program.
  workers_.reserve(static_cast<size_t>(threads - 1));
  try {
    for (int worker = 1; worker < threads; ++worker)
      workers_.push_back(start_thread([this, worker] { work_on_jobs(worker); }));
  } catch (...) {
    stop();
    throw;
  }
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::run(size_t count, const std::function<void(size_t, int)>& work,
                     const std::function<void(double)>& progress) {
  const int helpers = count > 1 ? static_cast<int>(workers_.size()) : 0;
  {
    const std::lock_guard lock(mutex_);
    job_ = {count, &work, &progress};
    next_.store(0, std::memory_order_relaxed);
    failure_ = nullptr;
    busy_ = helpers;
    if (helpers > 0) ++job_number_;
  }
  if (helpers > 0) start_.notify_all();
  take_pieces(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
  if (failure_) std::rethrow_exception(failure_);
}

void ThreadPool::work_on_jobs(int worker) {
  for (size_t last_job = 0;;) {
    for (int turn = 0; turn < turns_before_sleep && !stopping_ && job_number_ == last_job; ++turn)
      pause_processor();
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stopping_ || job_number_ != last_job; });
      if (stopping_) return;
      last_job = job_number_;
    }
    take_pieces(worker);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void ThreadPool::take_pieces(int worker) {
  try {
    for (;;) {
      // Before a piece is taken: whoever waits for a piece that was taken must see it worked on.
      const size_t begun = next_.load(std::memory_order_relaxed);
      if (worker == 0 && *job_.progress && begun < job_.count)
        (*job_.progress)(static_cast<double>(begun) / static_cast<double>(job_.count));
      const size_t piece = next_.fetch_add(1, std::memory_order_relaxed);
      if (piece >= job_.count) return;
      (*job_.work)(piece, worker);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    next_.store(job_.count, std::memory_order_relaxed);
  }
}

void parallel_for(int threads, size_t count, const std::function<void(size_t)>& work,
                  const Progress& progress, std::string_view step) {
  if (!step.empty()) progress(0.0, step);
  ThreadPool pool(count > 1 ? threads : 1);
  pool.run(
      count, [&](size_t i, int) { work(i); }, [&](double share) { progress(share, step); });
}

void lower_thread_priority() {
  const sched_param lowest{};
  ::sched_setscheduler(0, SCHED_BATCH, &lowest);
}

}  // namespace ream
