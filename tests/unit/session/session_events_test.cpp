#include "session/live/session_events.hpp"

#include <gtest/gtest.h>

namespace ream::session {
namespace {

using device::LinkState;
using Kinds = std::vector<std::string>;

/// Ticks as a test tells them; what was found of each.
struct Told {
  Kinds tick(LinkState link, bool spindle_on = false, double thrust_n = 0.0, bool paused = false) {
    record::TickReport report;
    report.tick = next++;
    report.link = link;
    report.spindle_on = spindle_on;
    report.thrust_n = thrust_n;
    report.engaged = thrust_n > 0.0;
    report.paused = paused;
    Kinds kinds;
    for (const record::ops::Event& event : events.of(report)) {
      EXPECT_EQ(event.tick, report.tick);
      EXPECT_NE(event.words, "");
      kinds.push_back(event.kind);
    }
    return kinds;
  }
  SessionEvents events;
  uint32_t next = 0;
};

TEST(SessionEvents, ADeviceThatIsThereFromTheStartIsNoEvent) {
  Told told;
  for (const LinkState link : {LinkState::fresh, LinkState::held, LinkState::fading, LinkState::fresh})
    EXPECT_EQ(told.tick(link), Kinds{});
  EXPECT_EQ(told.events.device_words(), "");
}

TEST(SessionEvents, APauseByAnybodyButTheDeviceIsTold) {
  SessionEvents events;
  record::TickReport report;
  const auto kinds = [&](bool paused, bool held) {
    report.paused = paused;
    report.held = held;
    Kinds found;
    for (const record::ops::Event& event : events.of(report)) found.push_back(event.kind);
    return found;
  };
  EXPECT_EQ(kinds(false, false), Kinds{});
  EXPECT_EQ(kinds(true, false), Kinds{});
  EXPECT_EQ(kinds(true, true), Kinds{"paused"});
  EXPECT_EQ(kinds(true, true), Kinds{});
  EXPECT_EQ(kinds(true, false), Kinds{"continued"});
  EXPECT_EQ(kinds(false, false), Kinds{});
}

TEST(SessionEvents, LostAndBackAreToldOnceEach) {
  Told told;
  told.tick(LinkState::fresh);
  EXPECT_EQ(told.tick(LinkState::lost), Kinds{"device_lost"});
  EXPECT_EQ(told.tick(LinkState::lost), Kinds{});
  EXPECT_EQ(told.events.device_words(), device_lost_words);
  EXPECT_EQ(told.tick(LinkState::fading), Kinds{"device_back"});
  EXPECT_EQ(told.tick(LinkState::fresh), Kinds{});
  EXPECT_EQ(told.events.device_words(), "");
  EXPECT_EQ(told.tick(LinkState::lost), Kinds{"device_lost"}) << "and again";
}

TEST(SessionEvents, OneThatHasNotComeYetIsAwaitedAndNotLost) {
  Told told;
  EXPECT_EQ(told.tick(LinkState::lost), Kinds{});
  EXPECT_EQ(told.events.device_words(), device_awaited_words);
  EXPECT_EQ(told.tick(LinkState::fresh), Kinds{"device_back"});
}

TEST(SessionEvents, AStartUnderLoadIsTheSpindlesRisingEdgeWhilePressed) {
  Told told;
  const double load_n = SessionEvents::loaded_thrust_n;
  EXPECT_EQ(told.tick(LinkState::fresh, true, load_n), Kinds{}) << "on from the first tick on: no edge";
  told.tick(LinkState::fresh, false, load_n);
  EXPECT_EQ(told.tick(LinkState::fresh, true, load_n), Kinds{"spindle_loaded"});
  EXPECT_EQ(told.tick(LinkState::fresh, true, 10.0 * load_n), Kinds{});
  told.tick(LinkState::fresh, false, load_n);
  EXPECT_EQ(told.tick(LinkState::fresh, true, 0.9 * load_n), Kinds{}) << "it only rests on the bone";
  told.tick(LinkState::fresh, false, 0.0);
  EXPECT_EQ(told.tick(LinkState::fresh, true, 0.0), Kinds{}) << "in the air";
}

TEST(SessionEvents, AStartDuringAPauseCountsWhenThePauseEnds) {
  Told told;
  told.tick(LinkState::fresh, false, 20.0);
  EXPECT_EQ(told.tick(LinkState::fresh, true, 0.0, true), Kinds{});
  EXPECT_EQ(told.tick(LinkState::fresh, true, 20.0), Kinds{"spindle_loaded"});
}

}  // namespace
}  // namespace ream::session
