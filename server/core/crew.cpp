#include "core/crew.hpp"

#include <algorithm>

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

Crew::Crew(int threads) {
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  try {
    for (int worker = 1; worker < threads; ++worker) helpers_.emplace_back([this, worker] { help(worker); });
  } catch (...) {
    send_home();
    throw;
  }
}

Crew::~Crew() { send_home(); }

void Crew::send_home() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  start_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void Crew::run(size_t count, const std::function<void(size_t, int)>& work,
               const std::function<void(double)>& told) {
  {
    const std::lock_guard lock(mutex_);
    job_ = {count, &work, &told};
    next_.store(0, std::memory_order_relaxed);
    failure_ = nullptr;
    busy_ = count > 1 ? static_cast<int>(helpers_.size()) : 0;
    if (busy_ > 0) ++number_of_job_;
  }
  if (busy_ > 0) start_.notify_all();
  take_pieces(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
  if (failure_) std::rethrow_exception(failure_);
}

void Crew::help(int worker) {
  for (size_t jobs_seen = 0;;) {
    for (int turn = 0; turn < turns_before_sleep && !ends_ && number_of_job_ == jobs_seen; ++turn)
      pause_processor();
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return ends_ || number_of_job_ != jobs_seen; });
      if (ends_) return;
      jobs_seen = number_of_job_;
    }
    take_pieces(worker);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void Crew::take_pieces(int worker) {
  try {
    for (;;) {
      // Told before a piece is taken: whoever waits for a piece that was taken must see it worked on.
      const size_t begun = next_.load(std::memory_order_relaxed);
      if (worker == 0 && *job_.told && begun < job_.count)
        (*job_.told)(static_cast<double>(begun) / static_cast<double>(job_.count));
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

}  // namespace ream
