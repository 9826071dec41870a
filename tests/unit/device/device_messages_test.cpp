#include "device/network/device_messages.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "core/file.hpp"
#include "support/device_wire.hpp"
#include "support/seed.hpp"

namespace ream::device {
namespace {

using test::as_bytes;
using test::HandleWords;
using test::SteeringWords;

/// Made from proto/golden/*.json by `flatc -b`, so not by the code that reads it.
std::vector<std::byte> golden(const std::string& name) {
  return read_binary_file(test::source_folder() + "/proto/golden/device_" + name + ".bin");
}

template <typename Kind>
Kind taken(std::span<const std::byte> bytes) {
  const ClientMessage message = read_client_message(bytes);
  if (const auto* refusal = std::get_if<Refusal>(&message)) ADD_FAILURE() << refusal->reason;
  return std::get<Kind>(message);
}

std::string refusal(const std::string& bytes) {
  const ClientMessage message = read_client_message(as_bytes(bytes));
  const auto* refused = std::get_if<Refusal>(&message);
  return refused ? refused->reason : "";
}

TEST(DeviceMessages, ReadsTheGoldenGreeting) {
  const auto hello = taken<DeviceGreeting>(golden("hello"));
  EXPECT_EQ(hello.protocol_revision, device_protocol_revision);
  EXPECT_EQ(hello.name, "Touch on the second table");
}

TEST(DeviceMessages, ReadsTheGoldenHandle) {
  const auto handle = taken<InputMessage>(golden("handle"));
  EXPECT_EQ(handle.sequence, 4294967295u);
  EXPECT_EQ(handle.echo_us, 987654321u);
  EXPECT_EQ(handle.echo_age_us, 350u);
  EXPECT_FALSE(handle.input.steering);
  EXPECT_EQ(handle.input.rotation_wxyz, (std::array<double, 4>{0.5, -0.5, 0.5, -0.5}));
  EXPECT_EQ(handle.input.place_mm, (std::array<double, 3>{-12.5, 30.25, 100.125}));
  EXPECT_EQ(handle.input.hand_force_n, (std::array<double, 3>{1.5, -2.0, 0.25}));
  EXPECT_TRUE(handle.input.spindle_on);
  EXPECT_FALSE(handle.input.paused);
  EXPECT_TRUE(handle.input.clutch);
  EXPECT_TRUE(handle.input.deadman);
}

TEST(DeviceMessages, ReadsTheGoldenSteering) {
  const auto steering = taken<InputMessage>(golden("steering"));
  EXPECT_EQ(steering.sequence, 7u);
  EXPECT_EQ(steering.echo_age_us, 16000u);
  EXPECT_TRUE(steering.input.steering);
  EXPECT_EQ(steering.input.sideways_mm, (std::array<double, 3>{1.5, -2.5, 0.0}));
  EXPECT_EQ(steering.input.lean, (std::array<double, 3>{0.0, 0.25, -1.0}));
  EXPECT_EQ(steering.input.push_n, 52.5);
  EXPECT_TRUE(steering.input.spindle_on);
  EXPECT_TRUE(steering.input.paused);
}

TEST(DeviceMessages, TheGoldenAnswersSayWhatOursSay) {
  const auto welcome_bytes = golden("welcome"), feedback_bytes = golden("feedback");
  const wire::Welcome* welcome = test::read_device_message(welcome_bytes)->body_as_Welcome();
  const net::SharedBytes our_welcome = welcome_message({"k7m2", "browser", 3.25, browser_stale_limits});
  const wire::Welcome* ours = test::read_device_message(*our_welcome)->body_as_Welcome();
  EXPECT_EQ(ours->protocol_revision(), welcome->protocol_revision());
  EXPECT_EQ(ours->session_id()->str(), welcome->session_id()->str());
  EXPECT_EQ(ours->device()->str(), welcome->device()->str());
  EXPECT_EQ(ours->force_max_n(), welcome->force_max_n());
  EXPECT_EQ(ours->fade_ms(), welcome->fade_ms());
  EXPECT_EQ(ours->lost_ms(), welcome->lost_ms());

  DeviceFeedback feedback;
  feedback.sequence = 42;
  feedback.stamp_us = 1234567890123;
  feedback.state = SessionState::running;
  feedback.rtt_ms = 1.5;
  feedback.output = {1, 1, 61234, LinkState::fading, true, {0.5, -1.25, 2}, {10, -20, 30.5}, 52.5, -0.75};
  const net::SharedBytes our_feedback = feedback_message(feedback);
  const wire::Feedback* told = test::read_device_message(*our_feedback)->body_as_Feedback();
  const wire::Feedback* reference = test::read_device_message(feedback_bytes)->body_as_Feedback();
  EXPECT_EQ(told->sequence(), reference->sequence());
  EXPECT_EQ(told->stamp_us(), reference->stamp_us());
  EXPECT_EQ(told->tick(), reference->tick());
  EXPECT_EQ(told->link(), reference->link());
  EXPECT_EQ(told->state(), reference->state());
  EXPECT_EQ(told->force_n()->y(), reference->force_n()->y());
  EXPECT_EQ(told->torque_n_mm()->z(), reference->torque_n_mm()->z());
  EXPECT_EQ(told->thrust_n(), reference->thrust_n());
  EXPECT_EQ(told->vibration_g(), reference->vibration_g());
  EXPECT_EQ(told->engaged(), reference->engaged());
  EXPECT_EQ(told->rtt_ms(), reference->rtt_ms());
}

TEST(DeviceMessages, RefusesNumbersThatAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinite, -infinite}) {
    for (size_t i = 0; i < 4; ++i) {
      HandleWords turned;
      turned.rotation_wxyz[i] = bad;
      EXPECT_NE(refusal(test::handle_bytes(turned)), "") << i;
    }
    for (size_t i = 0; i < 3; ++i) {
      HandleWords placed, pulled;
      placed.place_mm[i] = bad;
      pulled.hand_force_n[i] = bad;
      SteeringWords beside, leaning;
      beside.sideways_mm[i] = bad;
      leaning.lean[i] = bad;
      EXPECT_NE(refusal(test::handle_bytes(placed)), "") << i;
      EXPECT_NE(refusal(test::handle_bytes(pulled)), "") << i;
      EXPECT_NE(refusal(test::steering_bytes(beside)), "") << i;
      EXPECT_NE(refusal(test::steering_bytes(leaning)), "") << i;
    }
    SteeringWords pushing;
    pushing.push_n = bad;
    EXPECT_NE(refusal(test::steering_bytes(pushing)), "");
  }
}

TEST(DeviceMessages, RefusesWhatNoHandCanDo) {
  HandleWords far, stretched, nearly;
  far.place_mm = {0, 2000.1, 0};
  EXPECT_NE(refusal(test::handle_bytes(far)), "");
  far.place_mm = {0, -2000.0, 0};
  EXPECT_EQ(refusal(test::handle_bytes(far)), "");
  stretched.rotation_wxyz = {1.0f, 0.1f, 0.0f, 0.0f};
  EXPECT_NE(refusal(test::handle_bytes(stretched)), "");
  nearly.rotation_wxyz = {1.0005f, 0.0f, 0.0f, 0.0f};
  const auto unit = taken<InputMessage>(as_bytes(test::handle_bytes(nearly))).input.rotation_wxyz;
  EXPECT_DOUBLE_EQ(unit[0], 1.0);
  SteeringWords pushing;
  pushing.push_n = -1001.0f;
  EXPECT_NE(refusal(test::steering_bytes(pushing)), "");
}

TEST(DeviceMessages, RefusesWhatOnlyAServerSaysAndWhatHasNoRotation) {
  for (const char* name : {"welcome", "feedback"}) {
    const auto bytes = golden(name);
    EXPECT_TRUE(std::holds_alternative<Refusal>(read_client_message(bytes))) << name;
  }
  flatbuffers::FlatBufferBuilder builder;
  const auto bare = wire::CreateHandle(builder, 1);
  EXPECT_NE(refusal(test::device_message(builder, wire::DeviceBody::Handle, bare)).find("rotation"),
            std::string::npos);
  flatbuffers::FlatBufferBuilder empty;
  empty.Finish(wire::CreateDeviceMessage(empty));
  EXPECT_NE(refusal({reinterpret_cast<const char*>(empty.GetBufferPointer()), empty.GetSize()}), "");
}

/// Whatever the bytes, the answer is a message within bounds or words.
TEST(DeviceMessages, DamagedBytesAreReadWithinBounds) {
  const uint32_t seed = test::seed(20261121);
  std::mt19937 random(seed);
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const char* name : {"hello", "handle", "steering"}) {
    const auto whole = golden(name);
    for (size_t size = 0; size < whole.size(); ++size) read_client_message(std::span(whole).first(size));
    for (int round = 0; round < 20000; ++round) {
      auto bytes = whole;
      for (int hits = 1 + static_cast<int>(random() % 4); hits > 0; --hits)
        bytes[random() % bytes.size()] ^= static_cast<std::byte>(1u << (random() % 8));
      const ClientMessage message = read_client_message(bytes);
      if (const auto* input = std::get_if<InputMessage>(&message)) {
        for (const double v : input->input.place_mm) ASSERT_LE(std::abs(v), 2000.0);
        ASSERT_LE(std::abs(input->input.push_n), 1000.0);
        double squares = 0.0;
        for (const double v : input->input.rotation_wxyz) squares += v * v;
        ASSERT_NEAR(squares, 1.0, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace ream::device
