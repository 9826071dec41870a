// Sessions that somebody's device takes part in, over the real server.
#include <gtest/gtest.h>

#include "core/hash.hpp"
#include "record/recording.hpp"
#include "support/fake_device_client.hpp"
#include "support/live_server.hpp"

namespace ream::test {
namespace {

using namespace std::chrono_literals;

class DeviceSessions : public testing::Test {
 protected:
  /// Pushes as a browser does until `done`.
  template <typename Condition>
  void push(FakeDeviceClient& client, float push_n, const std::string& what, Condition done) {
    LiveServer::until(what, [&] {
      std::this_thread::sleep_for(10ms);
      SteeringWords command;
      command.push_n = push_n;
      return done(client.say(command));
    });
  }
  double depth_mm(const std::string& id) const {
    return nlohmann::json::parse(
               http_request(server.port(), "GET", "/api/v1/sessions/" + id + "/metrics").body)
        .at("reaming_depth_mm");
  }

  const LiveServer server;
};

TEST_F(DeviceSessions, ABrowserReamsAndComesOut) {
  const std::string id = server.run({{"case", "slab"}, {"device", "browser"}});
  const nlohmann::json waiting = server.get(id).at("device");
  EXPECT_EQ(waiting.at("name"), "browser");
  EXPECT_EQ(waiting.at("profile"), "ideal");
  EXPECT_EQ(waiting.at("received"), 0);
  FakeDeviceClient client(server.port(), id);
  EXPECT_EQ(client.device(), "browser");
  push(client, 60.0f, "thrust", [](const Felt& felt) { return felt.thrust_n > 50.0 && felt.engaged; });
  push(client, 60.0f, "depth", [&](const Felt&) { return depth_mm(id) > 0.3; });
  EXPECT_EQ(server.get(id).at("state"), "running");
  push(client, -20.0f, "a way out", [](const Felt& felt) { return !felt.engaged && felt.thrust_n == 0.0; });
  LiveServer::until("a round trip", [&] { return server.get(id).at("device").at("rtt_ms").is_number(); });
  EXPECT_EQ(server.get(id).at("device").at("state"), "fresh");
  server.post("/" + id + "/stop");
  const session::VerifyResult again = server.reaming().verify(server.folder(id) / "recording.ream");
  EXPECT_FALSE(again.difference);
  EXPECT_EQ(read_json_file(server.folder(id) / "metrics.json").at("grid_hash"), to_hex(again.grid_hash));
}

TEST_F(DeviceSessions, GoesOnWithTheDeviceThatItHad) {
  const std::string id = server.run({{"case", "slab"}, {"device", "network"}, {"device_profile", "omega.3"}});
  {
    FakeDeviceClient client(server.port(), id);
    client.say(HandleWords{});
  }
  LiveServer::until("ticks", [&] { return server.get(id).at("tick") > 100; });
  server.post("/" + id + "/stop");
  const nlohmann::json session = read_json_file(server.folder(id) / "session.json");
  EXPECT_EQ(session.at("device"), "network");
  EXPECT_EQ(session.at("device_profile"), "omega.3");
  const nlohmann::json before = server.get(id);
  EXPECT_EQ(server.post("/" + id + "/resume").at("device").at("profile"), "omega.3");
  EXPECT_EQ(server.get(id).at("force_scale"), before.at("force_scale"));
  FakeDeviceClient client(server.port(), id);
  EXPECT_EQ(client.device(), "network");
  LiveServer::until("poses to be used", [&] {
    client.say(HandleWords{});
    return server.get(id).at("device").at("state") != "lost";
  });
  server.post("/" + id + "/stop");
  EXPECT_FALSE(server.reaming().verify(server.folder(id) / "recording.ream").difference);
}

TEST_F(DeviceSessions, AClientMayBeThereBeforeTheStartAndIsToldOfTheEnd) {
  const std::string id = server.post("", {{"case", "slab"}, {"device", "browser"}}).at("id");
  FakeDeviceClient client(server.port(), id);
  const Felt early = client.say(SteeringWords{});
  EXPECT_EQ(early.state, wire::SessionState::created);
  EXPECT_EQ(early.force(), 0.0);
  server.post("/" + id + "/start");
  LiveServer::until("the session to run",
                    [&] { return client.say(SteeringWords{}).state == wire::SessionState::running; });
  server.post("/" + id + "/stop");
  EXPECT_EQ(client.say(SteeringWords{}).state, wire::SessionState::stopped);
}

TEST_F(DeviceSessions, RefusalsAreInWords) {
  write_file_atomically(server.reaming().data() / "scripts/push.json",
                        RecordedReaming::push("ideal", 20.0).dump());
  const std::string scripted = server.post("", {{"case", "slab"}, {"script", "push"}}).at("id");
  const RawWebSocket client(server.port(), "/api/v1/sessions/" + scripted + "/device");
  EXPECT_EQ(client.handshake().status, 409);
  EXPECT_NE(client.handshake().body.find("does not connect itself"), std::string::npos);
  for (const auto& [wanted, words] :
       {std::pair{R"({"case": "slab", "device": "spoon"})", "there are script, network, browser"},
        {R"({"case": "slab", "device": "network", "device_profile": "spoon"})", "no device profile"},
        {R"({"case": "slab", "script": "push", "device_profile": "touch"})", "says its own"},
        {R"({"case": "slab", "script": "practice"})", "name one"}}) {
    const HttpReply reply = http_request(server.port(), "POST", "/api/v1/sessions", wanted);
    EXPECT_EQ(reply.status, 422) << wanted;
    EXPECT_NE(reply.body.find(words), std::string::npos) << reply.body;
  }
  const std::string id = server.post("", {{"case", "slab"}, {"device", "browser"}}).at("id");
  FakeDeviceClient stranger(server.port(), id, 77);
  EXPECT_FALSE(stranger.welcomed());
  EXPECT_EQ(stranger.closing().first, 4000);
}

}  // namespace
}  // namespace ream::test
