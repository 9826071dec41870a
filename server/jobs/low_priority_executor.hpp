#pragma once
#include <functional>
#include <mutex>

namespace ream::jobs {

/// Work of a few seconds that a request waits for, one after the other on a thread that gives way to haptic
/// loops. Few wait, so that there are always threads left for other requests. Thread-safe.
class LowPriorityExecutor {
 public:
  /// Returns when `work` has been done. Throws what it throws; Error unavailable when somebody waits already.
  void run(const std::function<void()>& work);

 private:
  std::mutex working_;
  std::mutex mutex_;
  int inside_ = 0;
};

}  // namespace ream::jobs
