#include "stream/telemetry.hpp"

#include "core/clock.hpp"
#include "stream/fanout.hpp"
#include "unit/stream/viewer.hpp"

namespace ream::stream {
namespace {

constexpr int64_t ns_per_ms = 1'000'000;

TelemetrySample at_tick(uint32_t tick) {
  TelemetrySample sample;
  sample.tick = tick;
  return sample;
}

TEST(Telemetry, AboutSixtyMessagesASecondAndNoSampleLost) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  TelemetryBatcher batcher(fanout);
  Viewer viewer;
  for (uint32_t tick = 0; tick < 1000; ++tick) {
    batcher.add(at_tick(tick));
    batcher.publish_if_due(tick * ns_per_ms);
    viewer.pull(*mailbox);
  }
  batcher.flush();
  viewer.pull(*mailbox);
  EXPECT_NEAR(viewer.telemetry_messages, 1000 / 15, 2);
  EXPECT_EQ(viewer.samples, 1000u);
  EXPECT_EQ(viewer.dropped, 0u);
}

/// What a viewer finds that has read nothing for so long, of a session with a sample a tick.
Viewer viewer_after_ms(uint32_t unread_ms) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  TelemetryBatcher batcher(fanout);
  for (uint32_t tick = 0; tick < unread_ms; ++tick) {
    batcher.add(at_tick(tick));
    if (tick % 5 == 0) batcher.publish_if_due(tick * ns_per_ms);
  }
  batcher.flush();
  Viewer viewer;
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.samples + viewer.dropped, unread_ms);
  return viewer;
}

TEST(Telemetry, AboutTwoSecondsWaitForASlowViewer) {
  EXPECT_EQ(viewer_after_ms(1900).dropped, 0u);
  const Viewer late = viewer_after_ms(10'000);
  EXPECT_GT(late.dropped, 0u);
  EXPECT_NEAR(static_cast<double>(late.samples), 2000, 30);
}

TEST(Telemetry, SaysWhenItWasOnItsWay) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  TelemetryBatcher batcher(fanout);
  const int64_t before_us = steady_ns() / 1000;
  batcher.add(at_tick(7));
  batcher.flush();
  const int64_t after_us = steady_ns() / 1000;
  const Message message = mailbox->next();
  const wire::Telemetry* t = wire::GetServerMessage(message->data())->body_as_Telemetry();
  ASSERT_NE(t, nullptr);
  EXPECT_GE(static_cast<int64_t>(t->stamp_us()), before_us);
  EXPECT_LE(static_cast<int64_t>(t->stamp_us()), after_us);
}

TEST(Telemetry, AGapEndsTheBatchAndIsCounted) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  TelemetryBatcher batcher(fanout);
  for (const uint32_t tick : {10u, 11u, 12u, 20u, 21u}) batcher.add(at_tick(tick));
  batcher.flush();
  const Message first = mailbox->next(), second = mailbox->next();
  const auto body = [](const Message& m) { return wire::GetServerMessage(m->data())->body_as_Telemetry(); };
  EXPECT_EQ(body(first)->first_tick(), 10u);
  EXPECT_EQ(body(first)->thrust_n()->size(), 3u);
  EXPECT_EQ(body(second)->first_tick(), 20u);
  EXPECT_EQ(body(second)->thrust_n()->size(), 2u);
  EXPECT_EQ(body(second)->dropped(), 7u);
}

TEST(Telemetry, TicksThatNeverCameAreSeenAsLoss) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  TelemetryBatcher batcher(fanout);
  Viewer viewer;
  for (uint32_t tick = 0; tick < 96; ++tick) {
    if (tick % 40 < 16) batcher.add(at_tick(tick));
    batcher.publish_if_due(tick * ns_per_ms);
  }
  batcher.flush();
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.samples, 48u);
  EXPECT_EQ(viewer.dropped, 48u);  // ticks 16..39 and 56..79; what follows the last sample is not known yet
}

TEST(Telemetry, StrideIsKept) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  TelemetryBatcher batcher(fanout, 5);
  for (const uint32_t tick : {5u, 10u, 15u, 30u}) batcher.add(at_tick(tick));
  batcher.flush();
  Viewer viewer;
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.telemetry_messages, 2);
  EXPECT_EQ(viewer.dropped, 2u);
}

}  // namespace
}  // namespace ream::stream
