// Clients that ask much of the server: whatever they do, the session goes on and the next good client is
// served.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <fstream>

#include "support/fake_device_client.hpp"
#include "support/live_server.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

class DeviceSoak : public testing::Test {
 protected:
  /// Of a simulated hand, as on a slow machine a loop with a real one may stand still for too long.
  DeviceSoak() : id(server.run({{"case", "slab"}, {"device", "browser"}})) {}
  ~DeviceSoak() override {
    FakeDeviceClient good(server.port(), id);
    EXPECT_TRUE(good.welcomed());
    EXPECT_EQ(good.say(SteeringWords{}).sequence, 1u);
    server.post("/" + id + "/stop");
    EXPECT_FALSE(server.reaming().verify(server.folder(id) / "recording.ream").difference);
  }
  nlohmann::json device() const { return server.get(id).at("device"); }

  const LiveServer server;
  const std::string id;
};

TEST_F(DeviceSoak, ReconnectsTwoHundredTimes) {
  for (int i = 0; i < 200; ++i) {
    FakeDeviceClient client(server.port(), id);
    ASSERT_TRUE(client.welcomed()) << i;
    EXPECT_EQ(client.say(SteeringWords{}).sequence, 1u);
    if (i % 2 == 0) client.vanish();
  }
  LiveServer::until("the counts", [this] { return device().at("received") >= 200; });
}

TEST_F(DeviceSoak, OfTwoThatFightOneIsHeardAtATimeAndBothAreTold) {
  std::atomic<int> replaced{0};
  const auto fight = [&] {
    for (int i = 0; i < 40; ++i) {
      FakeDeviceClient client(server.port(), id);
      for (int n = 0; n < 50; ++n) {
        client.send(SteeringWords{});
        if (!client.receive()) {
          EXPECT_EQ(client.closing().first, 4001);
          ++replaced;
          break;
        }
      }
    }
  };
  std::thread other(fight);
  fight();
  other.join();
  EXPECT_GT(replaced, 0);
}

TEST_F(DeviceSoak, ASenderThatDoesNotWaitIsAnsweredTogether) {
  FakeDeviceClient client(server.port(), id);
  constexpr uint32_t messages = 15000;  // fewer than what one connection may send at once
  std::thread sender([&] {
    for (uint32_t i = 0; i < messages; ++i) {
      SteeringWords words;
      words.sequence = i + 1;
      client.send_raw(steering_bytes(words));
    }
  });
  uint32_t answers = 0, newest = 0;
  while (newest < messages) {
    const Felt felt = client.receive().value();
    EXPECT_GT(felt.sequence, newest);
    newest = felt.sequence;
    ++answers;
  }
  sender.join();
  EXPECT_LE(answers, messages);
  LiveServer::until("the counts", [this] { return device().at("received") == messages; });
  EXPECT_EQ(device().at("missing"), 0);
}

TEST_F(DeviceSoak, AMessageOfAMegabyteEndsItsConnection) {
  FakeDeviceClient client(server.port(), id);
  const size_t size = 1024 * 1024;
  std::string frame = {static_cast<char>(0x82), static_cast<char>(0xff)};
  for (int shift = 56; shift >= 0; shift -= 8) frame += static_cast<char>(size >> shift & 0xff);
  frame += std::string(4, '\0') + std::string(size, 'x');
  client.socket().try_send(frame);
  try {
    EXPECT_EQ(client.closing().first, 1009);
  } catch (const std::runtime_error&) {
    // The close frame may be lost with the rest of the megabyte.
  }
}

TEST_F(DeviceSoak, OneThatDoesNotReadHoldsNobodyUp) {
  FakeDeviceClient deaf(server.port(), id, FakeDeviceClient::revision, 4096);
  for (uint32_t i = 0; i < 5000; ++i) {
    SteeringWords words;
    words.sequence = i + 1;
    deaf.send_raw(steering_bytes(words));
  }
  const uint32_t tick = server.get(id).at("tick");
  LiveServer::until("ticks", [&] { return server.get(id).at("tick") > tick + 100; });
  FakeDeviceClient other(server.port(), id);
  EXPECT_EQ(other.say(SteeringWords{}).sequence, 1u);
}

TEST(ExampleClient, InPythonIsAnswered) {
  const LiveServer server;
  const std::string id = server.run({{"case", "slab"}, {"device", "network"}});
  const std::string out = (server.folder(id) / "example.txt").string();
  const std::string command = "python3 " + source_folder() + "/tests/support/example_device_client.py " +
                              std::to_string(server.port()) + " " + id + " 200 > " + out + " 2>&1";
  const int failed = std::system(command.c_str());
  std::ifstream file(out);
  const std::string said((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(failed, 0) << said;
  EXPECT_NE(said.find("the last to message 200"), std::string::npos) << said;
}

}  // namespace
}  // namespace ream::test
