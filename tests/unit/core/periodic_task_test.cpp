#include "core/periodic_task.hpp"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

namespace ream {
namespace {

using namespace std::chrono_literals;

/// Counts calls; a test waits for one of them.
class Calls {
 public:
  std::chrono::milliseconds made(std::chrono::milliseconds wait) {
    const std::lock_guard lock(mutex_);
    ++count_;
    changed_.notify_all();
    return wait;
  }
  bool reach(int count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 10s, [&] { return count_ >= count; });
  }
  int count() {
    const std::lock_guard lock(mutex_);
    return count_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_ = 0;
};

TEST(PeriodicTask, WorksAgainAfterTheTimeThatTheWorkGave) {
  Calls calls;
  PeriodicTask task("test", [&] { return calls.made(1ms); });
  EXPECT_EQ(calls.count(), 0);
  task.start();
  EXPECT_TRUE(calls.reach(3));
}

TEST(PeriodicTask, WaitsUntilItIsWoken) {
  Calls calls;
  PeriodicTask task("test", [&] { return calls.made(1h); });
  task.start(1h);
  EXPECT_EQ(calls.count(), 0);
  for (int time = 1; time <= 3; ++time) {
    task.wake();
    EXPECT_TRUE(calls.reach(time));
  }
}

TEST(PeriodicTask, WhatIsWokenWhileItWorksIsWorkedOnOnceMore) {
  Calls calls;
  std::promise<void> begun, resume;
  std::atomic<bool> first = true;
  PeriodicTask task("test", [&] {
    if (first.exchange(false)) {
      begun.set_value();
      resume.get_future().wait();
    }
    return calls.made(1h);
  });
  task.start();
  begun.get_future().wait();
  task.wake();
  task.wake();
  resume.set_value();
  EXPECT_TRUE(calls.reach(2));
  task.stop();
  EXPECT_EQ(calls.count(), 2);
}

TEST(PeriodicTask, StopWaitsForWorkThatGoesOnAndBeginsNoMore) {
  std::promise<void> begun;
  std::atomic<int> ended = 0;
  PeriodicTask* self = nullptr;
  PeriodicTask task("test", [&] {
    begun.set_value();
    while (!self->stopping()) std::this_thread::yield();
    ++ended;
    return 0ms;
  });
  self = &task;
  task.start();
  begun.get_future().wait();
  task.stop();
  EXPECT_EQ(ended, 1);
  task.wake();
  task.stop();
  EXPECT_EQ(ended, 1);
}

TEST(PeriodicTask, TriesAgainAfterAFailure) {
  Calls calls;
  PeriodicTask task(
      "test",
      [&]() -> std::chrono::milliseconds {
        calls.made(0ms);
        throw std::runtime_error("the database is away");
      },
      1ms);
  task.start();
  EXPECT_TRUE(calls.reach(3));
}

TEST(PeriodicTask, MayBeStoppedWithoutHavingBegun) {
  PeriodicTask task("test", [] { return 1ms; });
  task.wake();
  task.stop();
}

}  // namespace
}  // namespace ream
