#include "session/replay/playhead.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::session {
namespace {

using test::expect_error;

constexpr int64_t second_ns = 1'000'000'000;

TEST(Playhead, RestsUntilItIsToldToPlay) {
  Playhead head(5000);
  head.advance(3 * second_ns);
  EXPECT_EQ(head.position_ticks(), 0u);
  head.change({true, {}, {}});
  head.advance(3 * second_ns);
  EXPECT_EQ(head.position_ticks(), 3000u);
  EXPECT_EQ(head.jumps(), 0u);
  head.change({false, {}, {}});
  head.advance(second_ns);
  EXPECT_EQ(head.position_ticks(), 3000u);
}

TEST(Playhead, GoesAtAnySpeedWithoutLosingTime) {
  for (const double speed : {0.1, 0.25, 1.0, 3.3, 16.0}) {
    std::mt19937 random(test::seed());
    Playhead head(1'000'000);
    head.change({true, speed, {}});
    int64_t passed_ns = 0;
    for (int i = 0; i < 2000; ++i) {
      const int64_t step_ns = random() % 20'000'000;
      passed_ns += step_ns;
      head.advance(step_ns);
    }
    EXPECT_NEAR(head.position_ticks(), static_cast<double>(passed_ns) * 1e-6 * speed, 1.0);
  }
}

TEST(Playhead, StaysAtTheEndAndPlaysFromTheStartAgain) {
  Playhead head(2500);
  head.change({true, 4.0, {}});
  head.advance(10 * second_ns);
  EXPECT_EQ(head.position_ticks(), 2500u);
  EXPECT_FALSE(head.playing());
  head.change({true, {}, {}});
  EXPECT_EQ(head.position_ticks(), 0u);
  EXPECT_EQ(head.jumps(), 1u);
  EXPECT_TRUE(head.playing());
  EXPECT_EQ(head.speed(), 4.0);
}

TEST(Playhead, JumpsToAMomentPlayingOrNot) {
  Playhead head(2500);
  head.change({{}, {}, 1.2345});
  EXPECT_EQ(head.position_ticks(), 1235u);
  EXPECT_FALSE(head.playing());
  head.change({true, {}, 2.5});
  EXPECT_EQ(head.position_ticks(), 2500u);
  head.change({{}, {}, 0.0});
  EXPECT_EQ(head.position_ticks(), 0u);
  EXPECT_EQ(head.jumps(), 3u);
}

TEST(Playhead, SpeedZeroRestsAndKeepsTheSpeed) {
  Playhead head(2500);
  head.change({true, 8.0, {}});
  head.change({{}, 0.0, {}});
  EXPECT_FALSE(head.playing());
  EXPECT_EQ(head.speed(), 8.0);
}

TEST(Playhead, RefusesWhatIsOutOfRangeAndChangesNothing) {
  Playhead head(2500);
  head.change({true, 2.0, 1.0});
  expect_error(ErrorKind::invalid_input, "speed must be 0 or from 0.1 to 16, not 0.05", [&] {
    head.change({false, 0.05, {}});
  });
  expect_error(ErrorKind::invalid_input, "not 17", [&] { head.change({false, 17.0, {}}); });
  expect_error(ErrorKind::invalid_input, "position_s must be from 0 to the duration, 2.5, not 2.6", [&] {
    head.change({false, 1.0, 2.6});
  });
  expect_error(ErrorKind::invalid_input, "not -0.1", [&] { head.change({false, 1.0, -0.1}); });
  EXPECT_TRUE(head.playing());
  EXPECT_EQ(head.speed(), 2.0);
  EXPECT_EQ(head.position_ticks(), 1000u);
}

}  // namespace
}  // namespace ream::session
