#include "net/transfer_pace.hpp"

#include <gtest/gtest.h>

namespace ream::net {
namespace {

using namespace std::chrono_literals;
const auto begin = TransferPace::Clock::now();

TEST(TransferPace, NobodyMayStall) {
  TransferPace pace(begin, 10s, 5s, 1000);
  EXPECT_EQ(pace.time_left(begin), 5s);
  pace.moved(1'000'000);
  EXPECT_EQ(pace.time_left(begin), 5s);
}

TEST(TransferPace, WhoDribblesIsOutOfTimeWhenTheGraceIsOver) {
  TransferPace pace(begin, 10s, 5s, 1000);
  for (int second = 0; second < 10; ++second) {
    EXPECT_GT(pace.time_left(begin + 1s * second), 0s);
    pace.moved(10);
  }
  EXPECT_EQ(pace.time_left(begin + 11s), 0s);
}

TEST(TransferPace, WhoKeepsTheLeastRateMayGoOn) {
  TransferPace pace(begin, 10s, 5s, 1000);
  for (int second = 0; second < 1000; ++second) {
    pace.moved(1000);
    EXPECT_EQ(pace.time_left(begin + 1s * second), 5s);
  }
}

}  // namespace
}  // namespace ream::net
