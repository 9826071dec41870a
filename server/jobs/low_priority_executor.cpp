#include "jobs/low_priority_executor.hpp"

#include "core/error.hpp"
#include "core/signal_handlers.hpp"
#include "core/thread_pool.hpp"

namespace ream::jobs {
namespace {

constexpr int max_inside = 2;  // one works, one waits

}  // namespace

void LowPriorityExecutor::run(const std::function<void()>& work) {
  {
    const std::lock_guard lock(mutex_);
    if (inside_ == max_inside)
      throw Error(ErrorKind::unavailable,
                  "other files are being made; try again in a few seconds, or ask for an export");
    ++inside_;
  }
  const auto done = [this] {
    const std::lock_guard lock(mutex_);
    --inside_;
  };
  try {
    const std::lock_guard one_at_a_time(working_);
    start_task([&work] {
      lower_thread_priority();
      work();
    }).get();
  } catch (...) {
    done();
    throw;
  }
  done();
}

}  // namespace ream::jobs
