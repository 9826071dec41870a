#include "net/worker_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

namespace ream::net {
namespace {

TEST(WorkerPool, RunsWhatItTook) {
  std::atomic<int> sum{0};
  std::promise<void> done;
  WorkerPool pool(3, 1000);
  for (int i = 1; i <= 500; ++i)
    ASSERT_TRUE(pool.submit([&, i] {
      if ((sum += i) == 500 * 501 / 2) done.set_value();
    }));
  done.get_future().wait();
  EXPECT_EQ(sum, 500 * 501 / 2);
}

TEST(WorkerPool, RefusesWhenFullAndAfterStop) {
  std::promise<void> begun, release;
  std::atomic<int> ran{0};
  WorkerPool pool(1, 2);
  ASSERT_TRUE(pool.submit([&] {
    begun.set_value();
    release.get_future().wait();
  }));
  begun.get_future().wait();
  EXPECT_TRUE(pool.submit([&] { ++ran; }));
  EXPECT_TRUE(pool.submit([&] { ++ran; }));
  EXPECT_FALSE(pool.submit([&] { ++ran; }));
  release.set_value();
  pool.stop();
  EXPECT_FALSE(pool.submit([&] { ++ran; }));
  EXPECT_LE(ran, 2);
}

}  // namespace
}  // namespace ream::net
