#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "core/latest_slot.hpp"
#include "core/spsc_ring.hpp"

namespace ream {
namespace {

TEST(SpscRing, RoundsItsCapacityUpToAPowerOfTwo) {
  EXPECT_EQ(SpscRing<int>(1).capacity(), 1u);
  EXPECT_EQ(SpscRing<int>(5).capacity(), 8u);
  EXPECT_EQ(SpscRing<int>(64).capacity(), 64u);
}

TEST(SpscRing, KeepsOrderAndSaysWhenFullOrEmpty) {
  SpscRing<int> ring(4);
  int item = -1;
  for (int round = 0; round < 3; ++round) {
    EXPECT_FALSE(ring.try_pop(item));
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.try_push(10 * round + i));
    EXPECT_FALSE(ring.try_push(99));
    EXPECT_EQ(ring.size(), 4u);
    for (int i = 0; i < 4; ++i) {
      EXPECT_TRUE(ring.try_pop(item));
      EXPECT_EQ(item, 10 * round + i);
    }
  }
  EXPECT_FALSE(ring.try_pop(item));
  EXPECT_EQ(item, 23) << "an empty ring leaves the item untouched";
}

TEST(SpscRing, LosesAndReordersNothingBetweenTwoThreads) {
  struct Item {
    uint64_t number = 0, twice = 0;
  };
  constexpr uint64_t count = 200'000;
  SpscRing<Item> ring(16);
  std::thread producer([&] {
    for (uint64_t i = 0; i < count;) {
      if (ring.try_push({i, 2 * i})) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  uint64_t wrong = 0;
  for (uint64_t expected = 0; expected < count;) {
    Item item;
    if (ring.try_pop(item)) {
      wrong += item.number != expected || item.twice != 2 * expected;
      ++expected;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(ring.size(), 0u);
}

TEST(LatestSlot, GivesOnlyTheNewestAndOnlyOnce) {
  LatestSlot<int> slot;
  int value = -1;
  EXPECT_FALSE(slot.take(value));
  EXPECT_EQ(value, -1);
  for (int round = 1; round < 5; ++round) {
    for (int i = 0; i < round; ++i) slot.store(10 * round + i);
    EXPECT_TRUE(slot.take(value));
    EXPECT_EQ(value, 10 * round + round - 1);
    EXPECT_FALSE(slot.take(value));
  }
}

TEST(LatestSlot, IsNeverTornNorOlderThanBefore) {
  using Wide = std::array<uint64_t, 32>;
  constexpr uint64_t count = 200'000;
  LatestSlot<Wide> slot;
  std::thread writer([&] {
    Wide value;
    for (uint64_t i = 1; i <= count; ++i) {
      value.fill(i);
      slot.store(value);
    }
  });
  uint64_t newest = 0, torn = 0, older = 0;
  while (newest < count) {
    Wide value{};
    if (!slot.take(value)) {
      std::this_thread::yield();
      continue;
    }
    for (const uint64_t word : value) torn += word != value[0];
    older += value[0] <= newest;
    newest = value[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(older, 0u);
  EXPECT_EQ(newest, count) << "the last value is always delivered";
}

}  // namespace
}  // namespace ream
