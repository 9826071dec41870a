#include "session/service/session_service.hpp"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "support/expect_error.hpp"
#include "support/fake_engine.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

using test::expect_error;
using test::FakeSession;

SessionRequest demo() { return {{}, "demo", "demo", {}}; }

class SessionServiceTest : public testing::Test {
 protected:
  SessionServiceTest() : service(engine, {3, 2}, folder.path(), database) {}
  std::string create() { return service.create(demo()).request.id; }

  const int alive_before = FakeSession::alive();
  const test::TemporaryFolder folder, store;
  store::Database database{"sqlite:" + (store.path() / "ream.db").string()};
  test::FakeEngine engine;
  SessionService service;
};

TEST_F(SessionServiceTest, GoesThroughItsStates) {
  const SessionRecord made = service.create({{}, "demo", "demo", 13.0});
  EXPECT_EQ(made.status.state, SessionState::created);
  EXPECT_EQ(made.status.force_scale, 13.0);
  EXPECT_EQ(engine.made(0).request().id, made.request.id);
  EXPECT_EQ(service.start(made.request.id).status.state, SessionState::running);
  expect_error(ErrorKind::conflict, "is running", [&] { service.start(made.request.id); });
  EXPECT_EQ(service.stop(made.request.id).status.state, SessionState::stopped);
  expect_error(ErrorKind::conflict, "is stopped", [&] { service.stop(made.request.id); });
  expect_error(ErrorKind::conflict, "is stopped", [&] { service.start(made.request.id); });
}

TEST_F(SessionServiceTest, UnknownIdIsNotFound) {
  expect_error(ErrorKind::not_found, "no session 'nobody'", [&] { service.get("nobody"); });
  expect_error(ErrorKind::not_found, "nobody", [&] { service.start("nobody"); });
  expect_error(ErrorKind::not_found, "nobody", [&] { service.metrics("nobody"); });
  expect_error(ErrorKind::not_found, "nobody", [&] { service.subscribe("nobody", 1); });
}

TEST_F(SessionServiceTest, ListsAllUnderDifferentIds) {
  const std::set<std::string> ids{create(), create(), create()};
  std::set<std::string> listed;
  for (const SessionRecord& record : service.list({}).sessions) listed.insert(record.request.id);
  EXPECT_EQ(listed, ids);
  EXPECT_EQ(ids.size(), 3u);
  for (const std::string& id : ids)
    EXPECT_EQ(id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789"), std::string::npos) << id;
}

TEST_F(SessionServiceTest, TheirMomentsOfCreationAreInTheOrderOfCreation) {
  std::string newest;
  for (int i = 0; i < 200; ++i) {
    const SessionRecord made = service.create(demo());
    EXPECT_GT(made.request.created_utc, newest);
    EXPECT_EQ(made.request.created_utc.size(), std::string("2025-03-01T12:00:00.250Z").size());
    newest = made.request.created_utc;
    service.stop(made.request.id);
  }
}

TEST_F(SessionServiceTest, OneTraineeDoesNotTakeAllPlaces) {
  SessionRequest own = demo(), others = demo();
  own.trainee_id = "tom";
  others.trainee_id = "tess";
  const std::string first = service.create(own, true).request.id;
  service.create(own, true);
  expect_error(ErrorKind::conflict, "2 of your sessions are live", [&] { service.create(own, true); });
  EXPECT_NO_THROW(service.reset(first, true)) << "one goes for one that comes";
  expect_error(ErrorKind::conflict, "stop one first", [&] { service.resume(first, "", true); });
  const std::string last = service.create(others, true).request.id;
  service.stop(last);
  EXPECT_NO_THROW(service.create(own)) << "staff may have more of them";
  expect_error(ErrorKind::unavailable, "3 sessions are live", [&] { service.create(others, true); });
}

TEST_F(SessionServiceTest, SessionsThatNobodyStartsEnd) {
  const std::string waits = create(), runs = create();
  service.start(runs);
  const auto now = std::chrono::steady_clock::now();
  service.end_unused(now + std::chrono::minutes(9));
  EXPECT_EQ(service.get(waits).status.state, SessionState::created);
  service.end_unused(now + std::chrono::minutes(11));
  EXPECT_EQ(service.get(waits).status.state, SessionState::stopped);
  EXPECT_EQ(service.get(runs).status.state, SessionState::running);
  SessionService patient(engine, {3, 2, 2, std::nullopt, std::nullopt}, folder.path(), database);
  const std::string kept = patient.create(demo()).request.id;
  patient.end_unused(now + std::chrono::hours(1000));
  EXPECT_EQ(patient.get(kept).status.state, SessionState::created);
}

TEST_F(SessionServiceTest, SessionsThatStayPausedEnd) {
  const std::string left = create(), used = create();
  service.start(left);
  service.start(used);
  service.pause(left);
  service.pause(used);
  const auto now = std::chrono::steady_clock::now();
  service.end_unused(now);
  service.end_unused(now + std::chrono::minutes(29));
  service.start(used);
  service.end_unused(now + std::chrono::minutes(29));
  service.pause(used);
  service.end_unused(now + std::chrono::minutes(31));
  EXPECT_EQ(service.get(left).status.state, SessionState::stopped);
  EXPECT_EQ(service.get(used).status.state, SessionState::paused) << "not without a break";
  service.end_unused(now + std::chrono::minutes(62));
  EXPECT_EQ(service.get(used).status.state, SessionState::stopped);
}

TEST_F(SessionServiceTest, NoMoreLiveSessionsThanStated) {
  const std::string first = create();
  create();
  create();
  expect_error(ErrorKind::unavailable, "3 sessions are live", [&] { create(); });
  service.stop(first);
  EXPECT_NO_THROW(create());
}

TEST_F(SessionServiceTest, AFailedFactoryTakesNoPlace) {
  for (int i = 0; i < 5; ++i)
    expect_error(ErrorKind::not_found, "missing", [&] { service.create({{}, "missing", "demo", {}}); });
  create();
  create();
  EXPECT_NO_THROW(create());
}

TEST_F(SessionServiceTest, ForgetsTheOldestEndedOnesOnly) {
  const std::string living = create();
  std::vector<std::string> ended;
  for (int i = 0; i < 4; ++i) {
    ended.push_back(create());
    service.stop(ended.back());
  }
  create();
  EXPECT_NO_THROW(service.get(living));
  expect_error(ErrorKind::not_found, ended[0], [&] { service.get(ended[0]); });
  expect_error(ErrorKind::not_found, ended[1], [&] { service.get(ended[1]); });
  EXPECT_NO_THROW(service.get(ended[2]));
  EXPECT_NO_THROW(service.get(ended[3]));
}

TEST_F(SessionServiceTest, AViewerKeepsAForgottenSession) {
  const std::string watched = create();
  service.stop(watched);
  auto viewer = service.subscribe(watched, 1);
  for (int i = 0; i < 3; ++i) service.stop(create());
  create();
  expect_error(ErrorKind::not_found, watched, [&] { service.get(watched); });
  const int alive = FakeSession::alive();
  viewer.reset();
  EXPECT_EQ(FakeSession::alive(), alive - 1);
}

TEST_F(SessionServiceTest, ShutDownStopsWhatRunsAndTakesNothingNew) {
  const std::string running = create(), over = create();
  service.start(running);
  service.stop(over);
  const int stops = FakeSession::stops();
  service.shut_down();
  EXPECT_EQ(FakeSession::stops(), stops + 1);
  EXPECT_EQ(service.get(running).status.state, SessionState::stopped);
  expect_error(ErrorKind::unavailable, "stopping", [&] { create(); });
}

TEST_F(SessionServiceTest, ManyThreadsNeverExceedTheLimit) {
  std::atomic<int> made{0}, refused{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&] {
      try {
        create();
        ++made;
      } catch (const Error&) {
        ++refused;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 3);
  EXPECT_EQ(refused, 5);
}

TEST_F(SessionServiceTest, ResetIsAnotherAttemptThatRunsIfTheOldOneDid) {
  SessionRequest wanted = demo();
  wanted.trainee = "Anna";
  wanted.keep = true;
  const std::string first = service.create(wanted).request.id;
  create();
  create();  // as many as may be live: the old one makes room
  service.start(first);
  auto viewer = service.subscribe(first, 1);
  EXPECT_FALSE(viewer->close_reason());
  const SessionRecord second = service.reset(first);
  EXPECT_EQ(second.status.state, SessionState::running);
  EXPECT_EQ(second.request.attempt, 2);
  EXPECT_EQ(second.request.reset_of, first);
  EXPECT_EQ(second.request.trainee, "Anna");
  EXPECT_FALSE(second.request.keep);
  EXPECT_EQ(service.get(first).status.state, SessionState::stopped);
  EXPECT_EQ(service.get(first).request.followed_by, second.request.id);
  const auto close_reason = viewer->close_reason();
  ASSERT_TRUE(close_reason);
  EXPECT_EQ(close_reason->code, 4001);
  EXPECT_NE(close_reason->text.find(second.request.id), std::string::npos);
  EXPECT_FALSE(service.subscribe(first, 1)->close_reason()) << "who comes later may look at what is left";
  expect_error(ErrorKind::conflict, second.request.id, [&] { service.reset(first); });
  service.stop(second.request.id);
  const SessionRecord third = service.reset(second.request.id);
  EXPECT_EQ(third.request.attempt, 3);
  EXPECT_EQ(third.status.state, SessionState::created) << "the old one did not run";
}

TEST_F(SessionServiceTest, AResetThatCannotBeMadeLeavesTheSessionAsItWas) {
  const std::string id = create();
  service.start(id);
  engine.refuse = [&] {
    EXPECT_TRUE(service.get(id).status.held) << "the hand holds nothing meanwhile";
    throw Error(ErrorKind::unavailable, "no memory");
  };
  expect_error(ErrorKind::unavailable, "no memory", [&] { service.reset(id); });
  EXPECT_EQ(service.get(id).status.state, SessionState::running);
  service.pause(id);
  expect_error(ErrorKind::unavailable, "no memory", [&] { service.reset(id); });
  EXPECT_TRUE(service.get(id).status.held);
  engine.refuse = nullptr;
  EXPECT_EQ(service.reset(id).status.state, SessionState::running);
}

TEST_F(SessionServiceTest, PausesOnlyWhatIsUnderWay) {
  const std::string id = create();
  expect_error(ErrorKind::conflict, "only a running session", [&] { service.pause(id); });
  service.start(id);
  engine.made(0).set(SessionState::paused);
  expect_error(ErrorKind::conflict, "by its own device", [&] { service.start(id); });
  EXPECT_TRUE(service.pause(id).status.held);
  EXPECT_FALSE(service.start(id).status.held);
  service.stop(id);
  expect_error(ErrorKind::conflict, "is stopped", [&] { service.pause(id); });
}

}  // namespace
}  // namespace ream::session
