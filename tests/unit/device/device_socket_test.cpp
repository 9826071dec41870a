#include "device/network/device_socket.hpp"

#include <gtest/gtest.h>

#include "support/device_wire.hpp"

namespace ream::device {
namespace {

using test::as_bytes;
using test::HandleWords;

int64_t now_ns = 0;
int64_t test_clock() { return now_ns; }

/// One connection as net runs it.
struct Client {
  explicit Client(DevicePort& port, uint32_t revision = device_protocol_revision) : session(port.connect()) {
    session->on_open([this] { ++woken; });
    say(test::greeting_bytes(revision, "test"));
  }
  ~Client() { session->on_close(); }
  void say(const std::string& bytes) { session->on_message(as_bytes(bytes)); }
  void say(const HandleWords& words) { say(test::handle_bytes(words)); }

  const wire::DeviceMessage* answer() {
    const auto next = session->next();
    if (!next) return nullptr;
    kept = *next;
    return test::read_device_message(*kept);
  }
  const wire::Feedback* feedback() {
    for (;;) {
      const wire::DeviceMessage* message = answer();
      if (message == nullptr) return nullptr;
      if (message->body_as_Feedback() != nullptr) return message->body_as_Feedback();
    }
  }

  std::unique_ptr<net::WebSocketSession> session;
  net::SharedBytes kept;
  int woken = 0;
};

class DeviceSocketTest : public testing::Test {
 protected:
  DeviceSocketTest() {
    now_ns = 5'000'000'000;
    port->set_state(SessionState::running);
  }
  void write_force(double force_n, uint64_t connection = 1) {
    RemoteOutput output;
    output.connection = connection;
    output.written_ns = now_ns;
    output.tick = 77;
    output.link = LinkState::fresh;
    output.force_n = {0, 0, force_n};
    output.torque_n_mm = {force_n, 0, 0};
    link->output.store(output);
  }
  static HandleWords numbered(uint32_t sequence, double x_mm = 0.0) {
    HandleWords words;
    words.sequence = sequence;
    words.place_mm[0] = x_mm;
    return words;
  }

  std::shared_ptr<RemoteLink> link = std::make_shared<RemoteLink>();
  std::shared_ptr<DevicePort> port = std::make_shared<DevicePort>(
      link, RemoteKind::handle, DeviceWelcome{"abcd", "network", 3.3, haptic_stale_limits}, test_clock);
};

TEST_F(DeviceSocketTest, AGreetingIsAnsweredByAWelcome) {
  Client client(*port);
  const wire::Welcome* welcome = client.answer()->body_as_Welcome();
  ASSERT_NE(welcome, nullptr);
  EXPECT_EQ(welcome->session_id()->str(), "abcd");
  EXPECT_FLOAT_EQ(welcome->force_max_n(), 3.3f);
  EXPECT_EQ(client.answer(), nullptr);
  EXPECT_EQ(client.session->close_reason(), std::nullopt);
  EXPECT_EQ(link->connections, 1u);
}

TEST_F(DeviceSocketTest, AnotherRevisionIsToldSo) {
  Client client(*port, device_protocol_revision + 1);
  EXPECT_EQ(client.answer(), nullptr);
  const auto close_reason = client.session->close_reason().value();
  EXPECT_EQ(close_reason.code, static_cast<uint16_t>(DeviceClose::other_revision));
  EXPECT_NE(close_reason.text.find("revision 1"), std::string::npos) << close_reason.text;
  EXPECT_EQ(link->connections, 0u);
}

TEST_F(DeviceSocketTest, EveryMessageIsAnsweredWithTheNewestForce) {
  Client client(*port);
  client.say(numbered(1, 12.0));
  RemoteInput input;
  ASSERT_TRUE(link->input.take(input));
  EXPECT_EQ(input.place_mm[0], 12.0);
  EXPECT_EQ(input.arrived_ns, now_ns);
  EXPECT_EQ(input.connection, 1u);
  write_force(1.5);
  const wire::Feedback* feedback = client.feedback();
  ASSERT_NE(feedback, nullptr);
  EXPECT_EQ(feedback->sequence(), 1u);
  EXPECT_EQ(feedback->tick(), 77u);
  EXPECT_EQ(feedback->force_n()->z(), 1.5f);
  EXPECT_EQ(feedback->state(), wire::SessionState::running);
  EXPECT_EQ(feedback->stamp_us(), 5'000'000u);
  EXPECT_EQ(client.feedback(), nullptr);
}

TEST_F(DeviceSocketTest, OldForcesAndThoseOfADeadLoopAreNotPassedOn) {
  Client client(*port);
  write_force(1.5);
  now_ns += output_too_old_ns;
  client.say(numbered(1));
  EXPECT_EQ(client.feedback()->force_n()->z(), 1.5f);
  now_ns += 1;
  client.say(numbered(2));
  const wire::Feedback* feedback = client.feedback();
  EXPECT_EQ(feedback->force_n()->z(), 0.0f);
  EXPECT_EQ(feedback->torque_n_mm()->x(), 0.0f);
  EXPECT_EQ(feedback->link(), wire::LinkState::lost);
}

TEST_F(DeviceSocketTest, NoForceOnceItWasTakenAwayOrTheSessionHasEnded) {
  Client client(*port);
  link->force_taken_away = true;
  write_force(1.5);
  client.say(numbered(1));
  EXPECT_EQ(client.feedback()->force_n()->z(), 0.0f);
  link->force_taken_away = false;
  for (const SessionState ended :
       {SessionState::finished, SessionState::stopped, SessionState::fault, SessionState::interrupted}) {
    port->set_state(ended);
    client.say(numbered(2));
    EXPECT_EQ(client.feedback()->force_n()->z(), 0.0f);
  }
  port->set_state(SessionState::paused);
  client.say(numbered(3));
  EXPECT_EQ(client.feedback()->force_n()->z(), 1.5f);
}

TEST_F(DeviceSocketTest, TheNewestNumberWins) {
  Client client(*port);
  for (const uint32_t sequence : {10u, 13u, 12u, 13u, 14u}) client.say(numbered(sequence, sequence));
  RemoteInput input;
  ASSERT_TRUE(link->input.take(input));
  EXPECT_EQ(input.place_mm[0], 14.0);
  EXPECT_EQ(link->received, 3u);
  EXPECT_EQ(link->missing, 2u);
  EXPECT_EQ(link->late, 2u);
  EXPECT_EQ(client.feedback()->sequence(), 14u);
}

TEST_F(DeviceSocketTest, NumbersMayGoRound) {
  Client client(*port);
  for (const uint32_t sequence : {UINT32_MAX - 1, UINT32_MAX, 0u, 1u}) client.say(numbered(sequence));
  EXPECT_EQ(link->received, 4u);
  EXPECT_EQ(link->missing + link->late + link->refused, 0u);
}

TEST_F(DeviceSocketTest, AJumpOfTheNumberDoesNotShutOutWhatFollows) {
  Client client(*port);
  for (const uint32_t sequence : {1u, 2'000'000'000u, 2u}) client.say(numbered(sequence));
  EXPECT_EQ(link->received, 2u);
  EXPECT_EQ(link->refused, 1u);
}

TEST_F(DeviceSocketTest, GarbageIsCountedUnansweredAndInTheEndShownTheDoor) {
  Client client(*port);
  client.answer();
  for (int i = 1; i < max_refusals; ++i) client.say(std::string("garbage"));
  EXPECT_EQ(link->refused, static_cast<uint64_t>(max_refusals - 1));
  EXPECT_EQ(client.answer(), nullptr);
  EXPECT_EQ(client.session->close_reason(), std::nullopt);
  client.say(numbered(1));
  EXPECT_NE(client.feedback(), nullptr);
  client.say(test::steering_bytes({}));
  const auto close_reason = client.session->close_reason().value();
  EXPECT_EQ(close_reason.code, static_cast<uint16_t>(DeviceClose::senseless));
  EXPECT_NE(close_reason.text.find("takes Handle only"), std::string::npos) << close_reason.text;
  RemoteInput input;
  link->input.take(input);
  client.say(numbered(2));
  EXPECT_FALSE(link->input.take(input));
}

TEST_F(DeviceSocketTest, OneThatDoesNotGreetIsNotHeard) {
  const auto session = port->connect();
  session->on_open([] {});
  session->on_message(as_bytes(test::handle_bytes(numbered(1))));
  RemoteInput input;
  EXPECT_FALSE(link->input.take(input));
  EXPECT_EQ(link->refused, 1u);
  session->on_close();
}

TEST_F(DeviceSocketTest, ANewClientTakesOver) {
  Client first(*port);
  first.say(numbered(1, 1.0));
  first.feedback();
  const int woken = first.woken;
  Client second(*port);
  EXPECT_EQ(first.woken, woken + 1);
  EXPECT_EQ(first.session->close_reason().value().code, static_cast<uint16_t>(DeviceClose::replaced));
  second.say(numbered(1, 2.0));
  first.say(numbered(2, 3.0));
  RemoteInput input;
  ASSERT_TRUE(link->input.take(input));
  EXPECT_EQ(input.place_mm[0], 2.0);
  EXPECT_EQ(input.connection, 2u);
  EXPECT_EQ(second.feedback()->sequence(), 1u);
  EXPECT_EQ(second.session->close_reason(), std::nullopt);
}

TEST_F(DeviceSocketTest, AForceIsForTheConnectionWhosePosesItAnswers) {
  Client first(*port), second(*port);
  write_force(1.5, 1);
  second.say(numbered(1));
  EXPECT_EQ(second.feedback()->force_n()->z(), 0.0f);
  write_force(1.5, 2);
  second.say(numbered(2));
  EXPECT_EQ(second.feedback()->force_n()->z(), 1.5f);
}

TEST_F(DeviceSocketTest, OneWithAnotherRevisionDoesNotTakeOver) {
  Client first(*port);
  Client stranger(*port, 99);
  EXPECT_EQ(first.session->close_reason(), std::nullopt);
}

TEST_F(DeviceSocketTest, TheRoundTripLeavesOutWhatTheClientKeptTheStampFor) {
  Client client(*port);
  client.say(numbered(1));
  EXPECT_LT(client.feedback()->rtt_ms(), 0.0f);
  HandleWords words = numbered(2);
  words.echo_us = static_cast<uint64_t>(now_ns / 1000);
  words.echo_age_us = 16'000;
  now_ns += 18'500'000;
  client.say(words);
  EXPECT_FLOAT_EQ(client.feedback()->rtt_ms(), 2.5f);
  EXPECT_EQ(link->rtt_us, 2500);
  // Senseless echoes change nothing.
  for (const uint64_t echo : {uint64_t{0}, uint64_t{1}, UINT64_MAX, static_cast<uint64_t>(now_ns)}) {
    ++words.sequence;
    words.echo_us = echo;
    client.say(words);
    EXPECT_EQ(link->rtt_us, 2500) << echo;
  }
}

}  // namespace
}  // namespace ream::device
