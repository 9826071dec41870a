#include "net/byte_budget.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace ream::net {
namespace {

TEST(ByteBudget, LendsWhatThereIsAndTakesItBack) {
  ByteBudget budget(100);
  ByteBudget::Lease one = budget.lend(60);
  EXPECT_TRUE(one);
  EXPECT_FALSE(budget.lend(41));
  {
    const ByteBudget::Lease two = budget.lend(40);
    EXPECT_TRUE(two);
    EXPECT_EQ(budget.left(), 0u);
    EXPECT_TRUE(budget.lend(0));
  }
  EXPECT_EQ(budget.left(), 40u);
  one = budget.lend(10);
  EXPECT_EQ(budget.left(), 90u);
  ByteBudget::Lease moved = std::move(one);
  one = {};
  EXPECT_EQ(budget.left(), 90u);
  moved = {};
  EXPECT_EQ(budget.left(), 100u);
}

TEST(ByteBudget, ThreadsNeverLendMoreThanTheSum) {
  ByteBudget budget(1000);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 10'000; ++i) {
        const auto lease = budget.lend(300);
        EXPECT_LE(budget.left(), 1000u);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(budget.left(), 1000u);
}

}  // namespace
}  // namespace ream::net
