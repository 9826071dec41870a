#include "sim/cpu_allocator.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/expect_error.hpp"

namespace ream::sim {
namespace {

using test::expect_error;

TEST(CpuAllocator, SpreadsLoopsOverTheProcessors) {
  CpuAllocator allocator({2, 5, 7});
  std::vector<std::unique_ptr<CpuAllocator::Reservation>> taken;
  std::multiset<int> cpus;
  for (int i = 0; i < 6; ++i) {
    taken.push_back(allocator.reserve("s" + std::to_string(i), 300.0));
    cpus.insert(taken.back()->cpu());
  }
  EXPECT_EQ(cpus, (std::multiset<int>{2, 2, 5, 5, 7, 7}));
}

TEST(CpuAllocator, RefusesWhatWouldMakeRunningLoopsMissAndSaysWhy) {
  CpuAllocator allocator({0});
  const auto first = allocator.reserve("first", 450.0);
  expect_error(ErrorKind::unavailable, "needs 300 us", [&] { allocator.reserve("second", 300.0); });
  expect_error(ErrorKind::unavailable, "use 450 us of 700", [&] { allocator.reserve("second", 300.0); });
  EXPECT_NO_THROW(allocator.reserve("small", 250.0));
}

TEST(CpuAllocator, IsFreeAgainWhenALoopHasGone) {
  CpuAllocator allocator({0});
  auto first = allocator.reserve("first", 600.0);
  expect_error(ErrorKind::unavailable, "Stop one first", [&] { allocator.reserve("second", 600.0); });
  first.reset();
  EXPECT_NO_THROW(allocator.reserve("second", 600.0));
}

TEST(CpuAllocator, GivesTheFirstLoopOfAProcessorItsPlaceHoweverSlowItIs) {
  CpuAllocator allocator({0, 1});
  const auto slow = allocator.reserve("slow", 1500.0);
  const auto next = allocator.reserve("next", 650.0);
  EXPECT_NE(slow->cpu(), next->cpu());
}

TEST(CpuAllocator, KnowsWhatARunningLoopReallyTakes) {
  CpuAllocator allocator({0});
  const auto first = allocator.reserve("first", 100.0);
  first->measured(500.0, 1000, 0);
  expect_error(ErrorKind::unavailable, "use 500 us", [&] { allocator.reserve("second", 250.0); });
  first->measured(200.0, 2000, 0);  // it rests; it may press again
  expect_error(ErrorKind::unavailable, "use 500 us", [&] { allocator.reserve("second", 250.0); });
}

TEST(CpuAllocator, AddsNothingToAMachineThatMissesAlready) {
  CpuAllocator allocator({0, 1, 2, 3});
  const auto first = allocator.reserve("struggling", 100.0);
  first->measured(100.0, 1000, 0);
  first->measured(100.0, 2000, 30);  // 3 % of the last thousand
  expect_error(ErrorKind::unavailable, "session struggling already misses 3 %",
               [&] { allocator.reserve("second", 100.0); });
  // Ten seconds without a miss later there is room again.
  for (uint64_t ticks = 3000; ticks <= 13'000; ticks += 500) first->measured(100.0, ticks, 30);
  EXPECT_NO_THROW(allocator.reserve("second", 100.0));
}

TEST(CpuAllocator, KnowsTheProcessorsOfThisMachine) {
  const std::vector<int> cpus = allowed_cpus();
  ASSERT_FALSE(cpus.empty());
  EXPECT_EQ(std::set<int>(cpus.begin(), cpus.end()).size(), cpus.size());
}

}  // namespace
}  // namespace ream::sim
