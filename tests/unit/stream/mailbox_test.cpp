#include "stream/mailbox.hpp"

#include <atomic>
#include <thread>

#include "stream/fanout.hpp"
#include "support/seed.hpp"
#include "unit/stream/viewer.hpp"

namespace ream::stream {
namespace {

Message any_hello() { return hello_message({}); }

SharedTelemetry telemetry(uint32_t tick, size_t samples) {
  TelemetryBatch batch;
  batch.samples.resize(samples);
  for (uint32_t i = 0; i < samples; ++i) batch.samples[i].tick = tick + i;
  return std::make_shared<const TelemetryBatch>(batch);
}

TEST(Mailbox, SlowViewerGetsOnlyTheNewestOfEachBlock) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  for (uint32_t revision = 1; revision <= 100; ++revision)
    for (uint32_t block = 0; block < 5; ++block) fanout.publish_block(small_block(block, revision));
  Viewer viewer;
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.blocks_received, 5u);
  for (const auto& [block, held] : viewer.blocks) EXPECT_EQ(held.revision, 100u);
}

TEST(Mailbox, SlowFastAndLateViewersEndWithTheSamePicture) {
  const unsigned seed = test::seed();
  std::mt19937 random(seed);
  for (int round = 0; round < 40; ++round) {
    Fanout fanout;
    fanout.publish_hello(any_hello());
    const auto fast_box = fanout.subscribe({}, 1), slow_box = fanout.subscribe({}, 1);
    std::shared_ptr<Mailbox> late_box;
    Viewer fast, slow, late;
    std::map<uint32_t, uint32_t> revisions;
    const uint32_t steps = 50 + static_cast<uint32_t>(random() % 300),
                   joins = static_cast<uint32_t>(random() % steps);
    const uint32_t complete = static_cast<uint32_t>(random() % steps);
    for (uint32_t step = 0; step < steps; ++step) {
      const auto block = static_cast<uint32_t>(random() % 12);
      fanout.publish_block(small_block(block, ++revisions[block], random() % 4 == 0));
      if (step == joins) late_box = fanout.subscribe({}, 1);
      if (step == complete) fanout.publish_picture_complete(1);
      fast.pull(*fast_box);
      if (random() % 10 == 0) slow.pull(*slow_box, 1);
      if (late_box && random() % 5 == 0) late.pull(*late_box, 1);
    }
    slow.pull(*slow_box);
    late.pull(*late_box);
    EXPECT_TRUE(fast.same_picture(slow) && fast.same_picture(late)) << "seed " << seed << " round " << round;
    for (const Viewer* v : {&fast, &slow, &late}) {
      EXPECT_EQ(v->hellos, 1);
      EXPECT_EQ(v->key_completes, 1);
    }
    EXPECT_LE(slow.blocks_received, fast.blocks_received);
  }
}

TEST(Mailbox, LateJoinersFirstPictureEndsWithKeyComplete) {
  Fanout fanout;
  for (uint32_t block = 0; block < 20; ++block) fanout.publish_block(small_block(block, 1));
  fanout.publish_block(small_block(7, 2, true));
  fanout.publish_picture_complete(1);
  const auto mailbox = fanout.subscribe({}, 1);
  fanout.publish_block(small_block(30, 1));  // news, after the picture
  Viewer viewer;
  viewer.pull(*mailbox, 1);
  EXPECT_EQ(viewer.key_completes, 1);
  EXPECT_EQ(viewer.blocks.size(), 19u);
  EXPECT_FALSE(viewer.blocks.contains(7) || viewer.blocks.contains(30));
  viewer.pull(*mailbox);
  EXPECT_TRUE(viewer.blocks.contains(30));
  EXPECT_EQ(viewer.key_completes, 1);
}

TEST(Mailbox, AnEmptyPictureIsCompleteToo) {
  Fanout fanout;
  const auto early = fanout.subscribe({}, 1);
  EXPECT_EQ(early->next(), nullptr);
  fanout.publish_picture_complete(1);
  const auto late = fanout.subscribe({}, 1);
  for (const auto& mailbox : {early, late}) {
    Viewer viewer;
    viewer.pull(*mailbox);
    EXPECT_EQ(viewer.key_completes, 1);
    EXPECT_EQ(viewer.mesh_messages, 1);
  }
}

TEST(Mailbox, MessagesStayNearTheirSize) {
  std::mt19937 random(test::seed(3));
  surface::BlockMesh mesh;
  for (uint32_t i = 0; i < 3000; ++i) {
    const auto r = [&] { return static_cast<uint16_t>(random() % 65536); };
    mesh.vertices.push_back({r(), r(), r(), 0, 0});
    mesh.indices.push_back(i);
  }
  Fanout fanout;
  for (mesh.block = 0; mesh.block < 60; ++mesh.block)
    fanout.publish_block(std::make_shared<const EncodedBlock>(encode(mesh, 1, 0)));
  const auto mailbox = fanout.subscribe({}, 1);
  Viewer viewer;
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.blocks.size(), 60u);
  EXPECT_GT(viewer.mesh_messages, 3);
  EXPECT_LT(viewer.mesh_messages, 30);
  EXPECT_LT(viewer.largest_mesh_message, Mailbox::mesh_message_bytes + 8192);
}

TEST(Mailbox, OldTelemetryIsDroppedAndCounted) {
  Fanout fanout;
  const auto mailbox = fanout.subscribe({}, 1);
  const size_t batches = Mailbox::max_telemetry_batches + 10;
  for (uint32_t i = 0; i < batches; ++i) fanout.publish_telemetry(telemetry(33 * i, 33));
  Viewer viewer;
  viewer.pull(*mailbox);
  EXPECT_EQ(viewer.telemetry_messages, 1) << "what waits goes together";
  EXPECT_EQ(viewer.dropped, 330u);
  EXPECT_EQ(viewer.samples + viewer.dropped, batches * 33);
}

TEST(Mailbox, OnlyTelemetryWithoutAGapGoesTogether) {
  Mailbox mailbox({});
  mailbox.put_telemetry(telemetry(0, 33));
  mailbox.put_telemetry(telemetry(33, 33));
  mailbox.put_telemetry(telemetry(99, 33));  // 33 ticks are missing
  auto jumped = std::make_shared<TelemetryBatch>(*telemetry(132, 33));
  for (TelemetrySample& sample : jumped->samples) sample.playback = Playback{0, 1.0f, true, 2};
  mailbox.put_telemetry(jumped);
  auto coarse = std::make_shared<TelemetryBatch>(*telemetry(165, 1));
  coarse->tick_stride = 10;
  coarse->stamp_us = 77;
  mailbox.put_telemetry(coarse);
  std::vector<std::pair<uint32_t, size_t>> sent;
  uint64_t stamp_us = 0;
  while (const Message message = mailbox.next()) {
    ASSERT_TRUE(verified(message->data(), message->size()));
    const wire::Telemetry* t = wire::GetServerMessage(message->data())->body_as_Telemetry();
    sent.emplace_back(t->first_tick(), t->thrust_n()->size());
    stamp_us = t->stamp_us();
  }
  EXPECT_EQ(sent, (std::vector<std::pair<uint32_t, size_t>>{{0, 66}, {99, 33}, {132, 33}, {165, 1}}));
  EXPECT_EQ(stamp_us, 77u);
}

TEST(Mailbox, UpdatesAreSmallSoThatTelemetryIsNotKeptWaiting) {
  Mailbox mailbox({});
  mailbox.put_picture_complete();
  Viewer viewer;
  viewer.pull(mailbox);
  for (uint32_t block = 0; block < 2000; ++block) mailbox.put_block(small_block(block, 1));
  viewer.pull(mailbox);
  EXPECT_EQ(viewer.blocks.size(), 2000u);
  EXPECT_GT(viewer.mesh_messages, 4);
  EXPECT_LT(viewer.largest_mesh_message, 2 * Mailbox::update_message_bytes);
}

TEST(Mailbox, TelemetryAndSurfaceTakeTurns) {
  Mailbox mailbox({});
  mailbox.put_block(small_block(1, 1));
  for (uint32_t i = 0; i < 4; ++i) mailbox.put_telemetry(telemetry(33 * i, 33));
  Viewer viewer;
  viewer.pull(mailbox, 2);
  EXPECT_EQ(viewer.mesh_messages, 1);
  EXPECT_EQ(viewer.telemetry_messages, 1);
}

TEST(Mailbox, WakesOnceWhenThereIsSomethingAgain) {
  Fanout fanout;
  int calls = 0;
  const auto mailbox = fanout.subscribe([&] { ++calls; }, 1);
  fanout.publish_block(small_block(1, 1));
  EXPECT_EQ(calls, 0);  // next() has not yet found nothing
  while (mailbox->next()) {
  }
  fanout.publish_block(small_block(1, 2));
  fanout.publish_block(small_block(2, 1));
  EXPECT_EQ(calls, 1);
}

TEST(Mailbox, LettingGoEndsTheSubscription) {
  Fanout fanout;
  auto mailbox = fanout.subscribe({}, 1);
  EXPECT_EQ(fanout.viewers(), 1u);
  mailbox.reset();
  EXPECT_EQ(fanout.viewers(), 0u);
  fanout.publish_block(small_block(1, 1));
}

TEST(Mailbox, ViewersInOtherThreadsEndWithTheSamePicture) {
  Fanout fanout;
  std::atomic<bool> done{false};
  std::array<Viewer, 2> viewers;
  std::vector<std::jthread> threads;
  for (Viewer& viewer : viewers)
    threads.emplace_back([&] {
      const auto mailbox = fanout.subscribe({}, 1);
      while (!done) viewer.pull(*mailbox);
      viewer.pull(*mailbox);
    });
  std::map<uint32_t, uint32_t> revisions;
  for (uint32_t i = 0; i < 3000; ++i)
    fanout.publish_block(small_block(i % 17, ++revisions[i % 17], i % 13 == 0));
  fanout.publish_picture_complete(1);
  done = true;
  threads.clear();
  Viewer late;
  const auto mailbox = fanout.subscribe({}, 1);
  late.pull(*mailbox);
  for (const Viewer& viewer : viewers) EXPECT_TRUE(viewer.same_picture(late));
}

}  // namespace
}  // namespace ream::stream
