#include "net/worker_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

namespace ream::net {
namespace {

constexpr auto yes = WorkerPool::Taken::yes, full = WorkerPool::Taken::full;

TEST(WorkerPool, RunsWhatItTook) {
  std::atomic<int> sum{0};
  std::promise<void> done;
  WorkerPool pool(3, 1000);
  for (int i = 1; i <= 500; ++i)
    ASSERT_EQ(yes, pool.submit([&, i] {
      if ((sum += i) == 500 * 501 / 2) done.set_value();
    }));
  done.get_future().wait();
  EXPECT_EQ(sum, 500 * 501 / 2);
}

TEST(WorkerPool, RefusesWhenFullAndAfterStop) {
  std::promise<void> begun, release;
  std::atomic<int> ran{0};
  WorkerPool pool(1, 2);
  ASSERT_EQ(yes, pool.submit([&] {
    begun.set_value();
    release.get_future().wait();
  }));
  begun.get_future().wait();
  EXPECT_EQ(yes, pool.submit([&] { ++ran; }));
  EXPECT_EQ(yes, pool.submit([&] { ++ran; }));
  EXPECT_EQ(full, pool.submit([&] { ++ran; }));
  release.set_value();
  pool.stop();
  EXPECT_EQ(full, pool.submit([&] { ++ran; }));
  EXPECT_LE(ran, 2);
}

TEST(WorkerPool, WhatAJobThrowsEndsItAndNothingElse) {
  struct Words {};
  std::promise<void> done;
  auto held = std::make_shared<int>(0);
  WorkerPool pool(1, 10);
  ASSERT_EQ(yes, pool.submit([held]() -> void { throw std::bad_alloc(); }));
  ASSERT_EQ(yes, pool.submit([held]() -> void { throw Words(); }));
  ASSERT_EQ(yes, pool.submit([&] { done.set_value(); }));
  done.get_future().wait();
  pool.stop();
  EXPECT_EQ(held.use_count(), 1) << "a connection that waits for its answer is let go of";
}

/// Jobs of one urgency that run until they are let go.
class HeldJobs {
 public:
  void fill(WorkerPool& pool, Urgency urgency, int threads) {
    for (int i = 0; i < threads; ++i) {
      std::promise<void> begun;
      ASSERT_EQ(yes, pool.submit(
                         [&] {
                           begun.set_value();
                           let_go_.wait();
                         },
                         urgency));
      begun.get_future().wait();
    }
  }
  void end() { release_.set_value(); }

 private:
  std::promise<void> release_;
  std::shared_future<void> let_go_ = release_.get_future().share();
};

void expect_runs(WorkerPool& pool, Urgency urgency) {
  std::promise<void> ran;
  ASSERT_EQ(yes, pool.submit([&] { ran.set_value(); }, urgency));
  ran.get_future().wait();
}

TEST(WorkerPool, UrgentJobsRunWhileAllOthersAreHeldUp) {
  HeldJobs held;
  WorkerPool pool(2, 10, SIZE_MAX, true);
  held.fill(pool, Urgency::usual, 2);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(yes, pool.submit([] {}));
  EXPECT_EQ(full, pool.submit([] {}));
  for (const Urgency urgency : {Urgency::entry, Urgency::halt, Urgency::health}) expect_runs(pool, urgency);
  held.fill(pool, Urgency::entry, 1);
  for (const Urgency urgency : {Urgency::halt, Urgency::health}) expect_runs(pool, urgency);
  held.fill(pool, Urgency::halt, 1);
  expect_runs(pool, Urgency::health);
  held.end();
}

TEST(WorkerPool, OneCallerDoesNotFillTheQueue) {
  constexpr auto caller_full = WorkerPool::Taken::caller_full;
  HeldJobs held;
  WorkerPool pool(1, 10, 4);
  held.fill(pool, Urgency::usual, 1);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(yes, pool.submit([] {}, Urgency::usual, "tom"));
  EXPECT_EQ(caller_full, pool.submit([] {}, Urgency::usual, "tom"));
  EXPECT_EQ(yes, pool.submit([] {}, Urgency::entry, "tom"));
  std::promise<void> last;
  EXPECT_EQ(yes, pool.submit([&] { last.set_value(); }, Urgency::usual, "tess"));
  held.end();
  last.get_future().wait();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(yes, pool.submit([] {}, Urgency::usual, "tom"));
}

}  // namespace
}  // namespace ream::net
