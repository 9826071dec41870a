#include "core/periodic_task.hpp"

#include <utility>

#include "core/log.hpp"
#include "core/signal_handlers.hpp"
#include "core/thread_pool.hpp"

namespace ream {

PeriodicTask::PeriodicTask(const char* name, Work work, std::chrono::milliseconds retry_after)
    : name_(name), work_(std::move(work)), retry_after_(retry_after) {}

void PeriodicTask::start(std::chrono::milliseconds delay, bool low_priority) {
  thread_ = start_thread([=, this] { run(delay, low_priority); });
}

void PeriodicTask::wake() {
  {
    const std::lock_guard lock(mutex_);
    woken_ = true;
  }
  changed_.notify_all();
}

void PeriodicTask::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void PeriodicTask::run(std::chrono::milliseconds wait, bool low_priority) {
  if (low_priority) lower_thread_priority();
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait_for(lock, wait, [this] { return stopping_ || woken_; });
    if (stopping_) return;
    woken_ = false;
    lock.unlock();
    wait = work_once();
    lock.lock();
  }
}

std::chrono::milliseconds PeriodicTask::work_once() {
  try {
    return work_();
  } catch (...) {
    log::current_exception(name_);
    return retry_after_;
  }
}

}  // namespace ream
