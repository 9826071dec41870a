#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace ream {

/// Work that is done again and again on a thread of its own: after a while, or when somebody wakes it. All
/// functions but start() are thread-safe; wake() and stop() may be called before start(), too.
class PeriodicTask {
 public:
  /// Does the work once and returns how long to wait until the next time. Should ask stopping() between
  /// longer steps. What it throws is logged as an error that begins with `name` ("retention"), and it is
  /// called again after `retry_after`.
  using Work = std::function<std::chrono::milliseconds()>;
  PeriodicTask(const char* name, Work work,
               std::chrono::milliseconds retry_after = std::chrono::milliseconds(1000));
  ~PeriodicTask() { stop(); }
  PeriodicTask(const PeriodicTask&) = delete;
  PeriodicTask& operator=(const PeriodicTask&) = delete;

  /// Makes the thread, which does the work for the first time after `delay`. `low_priority`: it takes no
  /// processor from a haptic loop.
  void start(std::chrono::milliseconds delay = {}, bool low_priority = true);
  /// The work is done again as soon as it can be, however long was to be waited. What was woken while it
  /// works is worked on once more.
  void wake();
  /// Waits for work that goes on; none begins afterwards. May be called twice, not from the work itself.
  void stop();
  bool stopping() const { return stopping_; }

 private:
  void run(std::chrono::milliseconds wait, bool low_priority);
  std::chrono::milliseconds work_once();

  const char* const name_;
  const Work work_;
  const std::chrono::milliseconds retry_after_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> stopping_{false};
  bool woken_ = false;
  std::thread thread_;
};

}  // namespace ream
