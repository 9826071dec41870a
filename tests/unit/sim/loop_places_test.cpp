#include "sim/loop_places.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/expect_error.hpp"

namespace ream::sim {
namespace {

using test::expect_error;

TEST(LoopPlaces, SpreadLoopsOverTheProcessors) {
  LoopPlaces places({2, 5, 7});
  std::vector<std::unique_ptr<LoopPlaces::Place>> taken;
  std::multiset<int> cpus;
  for (int i = 0; i < 6; ++i) {
    taken.push_back(places.take("s" + std::to_string(i), 300.0));
    cpus.insert(taken.back()->cpu());
  }
  EXPECT_EQ(cpus, (std::multiset<int>{2, 2, 5, 5, 7, 7}));
}

TEST(LoopPlaces, RefuseWhatWouldMakeRunningLoopsMissAndSayWhy) {
  LoopPlaces places({0});
  const auto first = places.take("first", 450.0);
  expect_error(ErrorKind::unavailable, "needs 300 us", [&] { places.take("second", 300.0); });
  expect_error(ErrorKind::unavailable, "use 450 us of 700", [&] { places.take("second", 300.0); });
  EXPECT_NO_THROW(places.take("small", 250.0));
}

TEST(LoopPlaces, AreFreeAgainWhenALoopHasGone) {
  LoopPlaces places({0});
  auto first = places.take("first", 600.0);
  expect_error(ErrorKind::unavailable, "Stop one first", [&] { places.take("second", 600.0); });
  first.reset();
  EXPECT_NO_THROW(places.take("second", 600.0));
}

TEST(LoopPlaces, GiveTheFirstLoopOfAProcessorItsPlaceHoweverSlowItIs) {
  LoopPlaces places({0, 1});
  const auto slow = places.take("slow", 1500.0);
  const auto next = places.take("next", 650.0);
  EXPECT_NE(slow->cpu(), next->cpu());
}

TEST(LoopPlaces, KnowWhatARunningLoopReallyTakes) {
  LoopPlaces places({0});
  const auto first = places.take("first", 100.0);
  first->measured(500.0, 1000, 0);
  expect_error(ErrorKind::unavailable, "use 500 us", [&] { places.take("second", 250.0); });
  first->measured(200.0, 2000, 0);  // it rests; it may press again
  expect_error(ErrorKind::unavailable, "use 500 us", [&] { places.take("second", 250.0); });
}

TEST(LoopPlaces, AddNothingToAMachineThatMissesAlready) {
  LoopPlaces places({0, 1, 2, 3});
  const auto first = places.take("struggling", 100.0);
  first->measured(100.0, 1000, 0);
  first->measured(100.0, 2000, 30);  // 3 % of the last thousand
  expect_error(ErrorKind::unavailable, "session struggling already misses 3 %",
               [&] { places.take("second", 100.0); });
  // Ten seconds without a miss later there is room again.
  for (uint64_t ticks = 3000; ticks <= 13'000; ticks += 500) first->measured(100.0, ticks, 30);
  EXPECT_NO_THROW(places.take("second", 100.0));
}

TEST(LoopPlaces, KnowTheProcessorsOfThisMachine) {
  const std::vector<int> cpus = allowed_cpus();
  ASSERT_FALSE(cpus.empty());
  EXPECT_EQ(std::set<int>(cpus.begin(), cpus.end()).size(), cpus.size());
}

}  // namespace
}  // namespace ream::sim
