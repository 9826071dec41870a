// Messages that are whole to the WebSocket and make no sense to those who read them.
#include <random>

#include "hostile_fixture.hpp"
#include "support/fake_device_client.hpp"
#include "support/seed.hpp"

namespace ream::test {
namespace {

class HostileMessagesTest : public HostileTest {
 protected:
  HostileMessagesTest() : seed_(test::seed()), random_(seed_) {}

  std::string noise(size_t most) {
    std::string bytes(random_() % (most + 1), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random_());
    return bytes;
  }
  /// A true message with a few bytes changed, or cut.
  std::string damaged(std::string message) {
    for (size_t i = 0, n = 1 + random_() % 4; i < n; ++i)
      message[random_() % message.size()] = static_cast<char>(random_());
    if (random_() % 4 == 0) message.resize(random_() % message.size());
    return message;
  }
  std::string senseless() {
    switch (random_() % 5) {
      case 0: return noise(200);
      case 1: return noise(60'000);
      case 2: return damaged(greeting_bytes(FakeDeviceClient::revision, "fake"));
      case 3: return damaged(handle_bytes({}));
      default: return damaged(steering_bytes({}));
    }
  }
  std::string seed() const { return "seed " + std::to_string(seed_); }

 private:
  const unsigned seed_;
  std::mt19937 random_;
};

TEST_F(HostileMessagesTest, ADeviceThatTalksNonsenseIsSentAway) {
  SCOPED_TRACE(seed());
  start();
  for (int round = 0; round < 50; ++round) {
    FakeDeviceClient client(port(), waiting());
    ASSERT_TRUE(client.welcomed());
    try {
      for (int i = 0; i < 400; ++i) client.send_raw(senseless());
    } catch (const std::runtime_error&) {
      continue;  // closed already
    }
    // What was damaged so little that it still is a message does not count against it.
    const auto [code, words] = client.closing();
    EXPECT_EQ(code, 4002) << words;
  }
  expect_others_are_served();
}

TEST_F(HostileMessagesTest, WhatComesBeforeTheGreetingIsNonsenseToo) {
  SCOPED_TRACE(seed());
  start();
  for (int round = 0; round < 50; ++round) {
    RawWebSocket client(port(), device_path());
    bool open = true;
    for (int i = 0; i < 400 && open; ++i) {
      try {
        client.send_binary(senseless());
      } catch (const std::runtime_error&) {
        open = false;
      }
    }
  }
  expect_others_are_served();
}

TEST_F(HostileMessagesTest, ADeviceThatBehavesTakesOverFromOneThatDoesNot) {
  SCOPED_TRACE(seed());
  start();
  FakeDeviceClient bad(port(), waiting());
  for (int i = 0; i < 10; ++i) bad.send_raw(noise(100));
  FakeDeviceClient good(port(), waiting());
  ASSERT_TRUE(good.welcomed());
  const Felt felt = good.say(HandleWords{});
  EXPECT_EQ(felt.sequence, good.sequence());
  EXPECT_EQ(bad.closing().first, 4001);
}

TEST_F(HostileMessagesTest, WhatAViewerSaysChangesNothing) {
  SCOPED_TRACE(seed());
  start();
  RawWebSocket viewer(port(), stream_path());
  for (int i = 0; i < 500; ++i) viewer.send_binary(senseless());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(viewer.receive().opcode, 2);
  expect_others_are_served();
}

}  // namespace
}  // namespace ream::test
