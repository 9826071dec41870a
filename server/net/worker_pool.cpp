#include "net/worker_pool.hpp"

#include "core/log.hpp"
#include "core/signal_handlers.hpp"

namespace ream::net {

WorkerPool::WorkerPool(size_t threads, size_t max_waiting, size_t max_of_caller, bool reserve)
    : max_waiting_(max_waiting), max_of_caller_(max_of_caller) {
  std::vector<Urgency> least(threads, Urgency::usual);
  if (reserve) least.insert(least.end(), {Urgency::health, Urgency::halt, Urgency::entry});
  threads_.reserve(least.size());
  try {
    for (const Urgency urgency : least) threads_.push_back(start_thread([this, urgency] { work(urgency); }));
  } catch (...) {
    stop();
    throw;
  }
}

WorkerPool::~WorkerPool() { stop(); }

WorkerPool::Taken WorkerPool::submit(std::function<void()> job, Urgency urgency, const std::string& caller) {
  {
    const std::lock_guard lock(mutex_);
    Lane& lane = lanes_[static_cast<size_t>(urgency)];
    if (stopped_ || lane.waiting.size() >= max_waiting_) return Taken::full;
    size_t& of_caller = lane.of_callers[caller];
    if (of_caller >= max_of_caller_) return Taken::caller_full;
    ++of_caller;
    lane.waiting.push_back({std::move(job), caller});
  }
  changed_.notify_all();  // not every thread may take it
  return Taken::yes;
}

void WorkerPool::stop() {
  std::array<Lane, 4> dropped;
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    dropped.swap(lanes_);
  }
  changed_.notify_all();
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
}

/// With the mutex held: the most urgent with a job, none beyond `least`.
WorkerPool::Lane* WorkerPool::next_lane(Urgency least) {
  for (size_t i = 0; i <= static_cast<size_t>(least); ++i)
    if (!lanes_[i].waiting.empty()) return &lanes_[i];
  return nullptr;
}

void WorkerPool::work(Urgency least) {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      Lane* lane = nullptr;
      changed_.wait(lock, [&] { return stopped_ || (lane = next_lane(least)) != nullptr; });
      if (stopped_) return;
      job = std::move(lane->waiting.front());
      lane->waiting.pop_front();
      if (--lane->of_callers[job.caller] == 0) lane->of_callers.erase(job.caller);
    }
    try {
      job.run();
    } catch (...) {
      log::current_exception("what a request or a file was waiting for failed");
    }
  }
}

}  // namespace ream::net
