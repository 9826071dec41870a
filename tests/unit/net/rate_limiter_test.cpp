#include "net/rate_limiter.hpp"

#include <gtest/gtest.h>

namespace ream::net {
namespace {

using namespace std::chrono_literals;

class RateLimiterTest : public testing::Test {
 protected:
  /// How many of `tries` pass at `at`.
  static int passed(RateLimiter& limiter, const std::string& key, int tries,
                    TokenBucket::Clock::time_point at) {
    int count = 0;
    for (int i = 0; i < tries; ++i) count += limiter.take(key, 1.0, at) == 0.0;
    return count;
  }
  const TokenBucket::Clock::time_point start = TokenBucket::Clock::now();
};

TEST_F(RateLimiterTest, BurstThenTheSteadyRate) {
  RateLimiter limiter({10.0, 20.0});
  EXPECT_EQ(passed(limiter, "a", 50, start), 20);
  EXPECT_EQ(passed(limiter, "a", 50, start + 1s), 10);
  EXPECT_EQ(passed(limiter, "a", 50, start + 1h), 20);
}

TEST_F(RateLimiterTest, SaysWhenThereIsRoomAgain) {
  RateLimiter limiter({10.0, 2.0});
  EXPECT_EQ(limiter.take("a", 2.0, start), 0.0);
  EXPECT_NEAR(limiter.take("a", 1.0, start), 0.1, 1e-9);
  EXPECT_EQ(limiter.take("a", 1.0, start + 101ms), 0.0);
}

TEST_F(RateLimiterTest, OneKeyCostsAnotherNothing) {
  RateLimiter limiter({1.0, 5.0});
  EXPECT_EQ(passed(limiter, "a", 50, start), 5);
  EXPECT_EQ(passed(limiter, "b", 50, start), 5);
}

TEST_F(RateLimiterTest, KeysAreBoundedAndBeyondThatShareOneBucket) {
  RateLimiter limiter({1.0, 5.0}, 100);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(passed(limiter, std::to_string(i), 9, start), 5);
  EXPECT_EQ(passed(limiter, "one", 9, start) + passed(limiter, "two", 9, start), 5);
  EXPECT_EQ(limiter.keys(), 100u);
  // Later the hundred are as good as new: the next newcomer sweeps them out.
  EXPECT_EQ(passed(limiter, "three", 9, start + 1min), 5);
  EXPECT_EQ(limiter.keys(), 1u);
}

TEST_F(RateLimiterTest, ClockThatStandsStillGivesNothing) {
  TokenBucket bucket({1000.0, 1.0}, start);
  EXPECT_EQ(bucket.take(1.0, start), 0.0);
  EXPECT_GT(bucket.take(1.0, start - 1s), 0.0);
  EXPECT_FALSE(bucket.full(start));
  EXPECT_TRUE(bucket.full(start + 1s));
}

}  // namespace
}  // namespace ream::net
