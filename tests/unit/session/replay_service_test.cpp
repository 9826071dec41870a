#include "session/service/replay_service.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "support/expect_error.hpp"
#include "support/fake_engine.hpp"

namespace ream::session {
namespace {

using test::expect_error;
using test::FakeReplay;

class ReplayServiceTest : public testing::Test {
 protected:
  ReplayServiceTest() : service(engine, ReplayLimits{.open = 2}) {}
  std::string create() { return service.create({{}, "abcdefgh", "demo", "demo"}).request.id; }

  const int alive_before = FakeReplay::alive();
  test::FakeEngine engine;
  ReplayService service;
};

TEST_F(ReplayServiceTest, AReplayHasAnIdOfItsOwnAndIsChanged) {
  const ReplayRecord made = service.create({{}, "abcdefgh", "demo", "demo"});
  EXPECT_EQ(made.request.replay_of, "abcdefgh");
  EXPECT_EQ(made.request.id.size(), 9u);
  EXPECT_TRUE(service.has(made.request.id));
  EXPECT_FALSE(service.has("abcdefgh"));
  const ReplayRecord changed = service.change(made.request.id, {true, 4.0, 2.5});
  EXPECT_TRUE(changed.status.playing);
  EXPECT_EQ(changed.status.speed, 4.0);
  EXPECT_EQ(service.get(made.request.id).status.position_s, 2.5);
  EXPECT_EQ(service.list().size(), 1u);
}

TEST_F(ReplayServiceTest, StoppedReplaysAreGone) {
  const std::string id = create();
  EXPECT_FALSE(service.stop(id).open);
  EXPECT_FALSE(service.has(id));
  EXPECT_EQ(FakeReplay::alive(), alive_before);
  expect_error(ErrorKind::not_found, id, [&] { service.get(id); });
  expect_error(ErrorKind::not_found, id, [&] { service.stop(id); });
  expect_error(ErrorKind::not_found, id, [&] { service.change(id, {}); });
  expect_error(ErrorKind::not_found, id, [&] { service.metrics(id); });
  expect_error(ErrorKind::not_found, id, [&] { service.subscribe(id, 1); });
}

TEST_F(ReplayServiceTest, TheOneUnwatchedForLongestGivesWay) {
  const std::string first = create(), second = create();
  engine.made_replay(0).set_unwatched_s(3.0);
  engine.made_replay(1).set_unwatched_s(5.0);
  const std::string third = create();
  EXPECT_TRUE(service.has(first));
  EXPECT_FALSE(service.has(second));
  EXPECT_TRUE(service.has(third));
}

TEST_F(ReplayServiceTest, WatchedReplaysStay) {
  create(), create();
  engine.made_replay(0).set_unwatched_s(0.0);
  engine.made_replay(1).set_unwatched_s(0.0);
  expect_error(ErrorKind::unavailable, "2 replays are watched", [&] { create(); });
  EXPECT_EQ(service.list().size(), 2u);
}

TEST_F(ReplayServiceTest, ARecordingThatCannotBeOpenedTakesNoPlace) {
  engine.refuse_replay = [] { throw Error(ErrorKind::invalid_input, "damaged"); };
  for (int i = 0; i < 5; ++i) expect_error(ErrorKind::invalid_input, "damaged", [&] { create(); });
  engine.refuse_replay = [] {};
  create(), create();
  EXPECT_EQ(service.list().size(), 2u);
}

TEST_F(ReplayServiceTest, AViewerKeepsAReplayThatWasStopped) {
  const std::string id = create();
  auto viewer = service.subscribe(id, 1);
  service.stop(id);
  EXPECT_EQ(FakeReplay::alive(), alive_before + 1);
  viewer.reset();
  EXPECT_EQ(FakeReplay::alive(), alive_before);
}

TEST_F(ReplayServiceTest, NothingIsOpenedAfterShutDown) {
  create();
  const int stops = FakeReplay::stops();
  service.shut_down();
  EXPECT_EQ(FakeReplay::stops(), stops + 1);
  EXPECT_EQ(FakeReplay::alive(), alive_before);
  expect_error(ErrorKind::unavailable, "stopping", [&] { create(); });
}

TEST_F(ReplayServiceTest, WhatIsNobodysEndsByItself) {
  const auto moment = std::chrono::milliseconds(1);
  ReplayService patient(engine, {.open = 3, .unattended = std::chrono::hours(1), .look_every = moment});
  ReplayService brief(engine, {.open = 3, .unattended = moment, .look_every = moment});
  const std::string kept = patient.create({{}, "abcdefgh", "demo", "demo"}).request.id;
  engine.made_replay(0).set_unwatched_s(7200.0);  // asked for a moment ago
  const int stops = FakeReplay::stops();
  const std::string left = brief.create({{}, "abcdefgh", "demo", "demo"}).request.id;
  while (brief.has(left)) std::this_thread::sleep_for(moment);
  while (FakeReplay::alive() > alive_before + 1) std::this_thread::sleep_for(moment);
  EXPECT_EQ(FakeReplay::stops(), stops + 1);
  EXPECT_TRUE(patient.has(kept));
}

TEST_F(ReplayServiceTest, WatchedReplaysDoNotEndByThemselves) {
  const auto moment = std::chrono::milliseconds(1);
  engine.first_unwatched_s = 0.0;
  ReplayService brief(engine, {.open = 2, .unattended = moment, .look_every = moment});
  const std::string watched = brief.create({{}, "abcdefgh", "demo", "demo"}).request.id;
  engine.first_unwatched_s = 1.0;
  const std::string left = brief.create({{}, "abcdefgh", "demo", "demo"}).request.id;
  while (brief.has(left)) std::this_thread::sleep_for(moment);
  EXPECT_TRUE(brief.has(watched));
}

TEST_F(ReplayServiceTest, HoldsFromManyThreads) {
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) try {
          const std::string id = create();
          service.change(id, {true, {}, {}});
          service.list();
          service.stop(id);
        } catch (const Error& e) {
          EXPECT_TRUE(e.kind() == ErrorKind::not_found || e.kind() == ErrorKind::unavailable) << e.what();
        }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(service.list().size(), 2u);
}

}  // namespace
}  // namespace ream::session
