#include "openigtlink/server.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "core/error.hpp"
#include "support/igtl_by_the_book.hpp"
#include "support/slicer_client.hpp"
#include "unit/openigtlink/watched_ball.hpp"

namespace ream::openigtlink {
namespace {

using test::IgtlReading;
using test::SlicerClient;

class OpenIgtlinkServer : public testing::Test {
 protected:
  static ServerOptions on_any_port() {
    ServerOptions options;
    options.port = 0;
    options.bone_interval_ns = 20'000'000;
    return options;
  }

  /// Tells where the tool is until the client has heard of a place.
  void tell_until_heard(WatchedBall& ball, SlicerClient& client, double x_mm) {
    ball.tell(x_mm);
    client.hear_until("the tool", [&](const IgtlReading& reading) {
      ball.tell(x_mm);
      return reading.name == "ReamerToRas" && reading.transform[9] == static_cast<float>(-x_mm);
    });
  }
  /// Waits until that many clients' mailboxes are there.
  static void until_viewers(WatchedBall& ball, size_t count) {
    for (int i = 0; i < 12000 && ball.fanout().viewers() != count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(ball.fanout().viewers(), count);
  }

  std::shared_ptr<ActiveSession> active_session_ = std::make_shared<ActiveSession>();
  Server server_{on_any_port(), active_session_};
};

TEST_F(OpenIgtlinkServer, SaysThatNothingRuns) {
  SlicerClient client(server_.port());
  const IgtlReading status = client.hear("Simulator");
  EXPECT_EQ(status.code, 13);
  EXPECT_EQ(status.text, "no session has been started");
}

TEST_F(OpenIgtlinkServer, WhoComesGetsEverythingAndThenWhatChanges) {
  WatchedBall ball;
  active_session_->set(ball.session());
  SlicerClient client(server_.port());
  EXPECT_EQ(client.hear("Session").text, "s1: a ball");
  EXPECT_EQ(client.hear("Reamer").triangles.size(), 4u);
  EXPECT_TRUE(corners_of(client.hear("Bone")) == corners_of(ball.surface()));
  ball.tell(10.0);
  const IgtlReading tool = client.hear("ReamerToRas");
  EXPECT_EQ(tool.transform, (std::array<float, 12>{-1, 0, 0, 0, -1, 0, 0, 0, 1, -10, -2, 3}));
  ball.tell(10.0);
  EXPECT_EQ(client.hear("Force").values, (std::vector<double>{52.0, 2.0}));
  ball.tell(10.0);
  EXPECT_EQ(client.hear("Torque").values, std::vector<double>{0.25});
  ball.cut(17);
  EXPECT_TRUE(corners_of(client.hear("Bone")) == corners_of(ball.surface()));
  ball.tell(11.0, SessionState::paused);
  EXPECT_EQ(
      client.hear_until("a pause", [](const IgtlReading& r) { return r.name == "Simulator" && r.code != 1; })
          .text,
      "the session is paused");
}

TEST_F(OpenIgtlinkServer, TheSessionThatWasShownLastIsTheOne) {
  WatchedBall first("first"), second("second");
  active_session_->set(first.session());
  SlicerClient client(server_.port());
  EXPECT_EQ(client.hear("Session").text, "first: a ball");
  second.cut(17);
  active_session_->set(second.session());
  EXPECT_EQ(client.hear("Session").text, "second: a ball");
  EXPECT_TRUE(corners_of(client.hear("Bone")) == corners_of(second.surface()));
  until_viewers(first, 0);
}

TEST_F(OpenIgtlinkServer, FollowsASessionOnlyWhileSomebodyWatches) {
  WatchedBall ball;
  active_session_->set(ball.session());
  EXPECT_EQ(ball.fanout().viewers(), 0u);
  {
    SlicerClient client(server_.port());
    client.hear("Bone");
    EXPECT_EQ(ball.fanout().viewers(), 1u);
  }
  until_viewers(ball, 0);
  ball.cut(17);
  SlicerClient again(server_.port());
  EXPECT_TRUE(corners_of(again.hear("Bone")) == corners_of(ball.surface()));
}

TEST_F(OpenIgtlinkServer, AClientThatDoesNotReadDisturbsNobodyAndThenGetsTheNewest) {
  WatchedBall ball;
  active_session_->set(ball.session());
  SlicerClient sleeper(server_.port());
  SlicerClient client(server_.port());
  client.hear("Bone");
  // Far more than the kernel takes for the sleeper.
  for (int brick = 0; brick < WatchedBall::bricks - 1; ++brick) {
    ball.cut(brick);
    client.hear("Bone");
  }
  tell_until_heard(ball, client, 77.0);
  sleeper.hear_until("the tool where it is now", [&](const IgtlReading& reading) {
    return reading.name == "ReamerToRas" && reading.transform[9] == -77.0f;
  });
  ball.cut(WatchedBall::bricks - 1);
  const auto now = corners_of(ball.surface());
  sleeper.hear_until("the bone as it is now",
                     [&](const IgtlReading& r) { return r.name == "Bone" && corners_of(r) == now; });
}

TEST_F(OpenIgtlinkServer, AClientThatIsKilledInAMessageDisturbsNobody) {
  WatchedBall ball;
  active_session_->set(ball.session());
  SlicerClient client(server_.port());
  client.hear("Bone");
  for (int i = 0; i < 5; ++i) {
    SlicerClient killed(server_.port());
    killed.raw(100 + static_cast<size_t>(i) * 1000);
  }
  tell_until_heard(ball, client, 5.0);
}

TEST_F(OpenIgtlinkServer, WhatClientsSayIsIgnored) {
  WatchedBall ball;
  active_session_->set(ball.session());
  SlicerClient client(server_.port());
  test::IgtlBytes noise(200'000);
  for (size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::byte>(i * 7);
  client.say(noise);
  tell_until_heard(ball, client, 6.0);
}

TEST_F(OpenIgtlinkServer, OnlySoManyMayCome) {
  WatchedBall ball;
  active_session_->set(ball.session());
  std::vector<std::unique_ptr<SlicerClient>> clients;
  for (size_t i = 0; i < on_any_port().max_clients; ++i) {
    clients.push_back(std::make_unique<SlicerClient>(server_.port()));
    clients.back()->hear("Bone");
  }
  SlicerClient one_more(server_.port());
  EXPECT_THROW(one_more.next(), std::runtime_error);
  for (auto& client : clients) tell_until_heard(ball, *client, 8.0);
}

TEST_F(OpenIgtlinkServer, ASessionThatIsGoneIsNotWaitedFor) {
  {
    WatchedBall ball;
    active_session_->set(ball.session());
  }
  SlicerClient client(server_.port());
  EXPECT_EQ(client.hear("Session").text, "s1: a ball");
  WatchedBall next("next");
  active_session_->set(next.session());
  EXPECT_TRUE(corners_of(client.hear("Bone")) == corners_of(next.surface()));
}

TEST_F(OpenIgtlinkServer, APortInUseIsSaidInOneLine) {
  ServerOptions options;
  options.port = server_.port();
  try {
    Server second(options, active_session_);
    FAIL() << "two servers have one port";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::unavailable);
    EXPECT_NE(std::string(e.what()).find("port " + std::to_string(server_.port())), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace ream::openigtlink
