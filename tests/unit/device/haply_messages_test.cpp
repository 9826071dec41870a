#include "device/vendors/haply_messages.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/expect_error.hpp"

namespace ream::device {
namespace {

using nlohmann::json;
using test::expect_error;

std::string message(const Vec3& force_n, HaplyForceForm form, HaplyRequest command,
                    const std::string& id = "049D") {
  std::string text = "what was there before";
  write_haply_message(text, id, force_n, form, command);
  return text;
}

/// As docs.haply.co gives the protocol of 3.5, without its spaces.
TEST(HaplyMessage, IsByteForByteTheDocumentedOne) {
  EXPECT_EQ(
      message({0, 0, 1.5}, HaplyForceForm::vector, HaplyRequest::configure),
      R"({"session":{"configure":{"profile":{"name":"ream.simulator:main"}}},)"
      R"("inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":0,"y":0,"z":1.5}}}}]})");
  EXPECT_EQ(
      message({0.25, -1.5, 1e-3}, HaplyForceForm::vector, HaplyRequest::nothing),
      R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":0.25,"y":-1.5,"z":0.001}}}}]})");
  EXPECT_EQ(
      message({0.25, -1.5, 1e-3}, HaplyForceForm::values, HaplyRequest::nothing),
      R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"values":{"x":0.25,"y":-1.5,"z":0.001}}}}]})");
}

/// As the maker's examples ask for it.
TEST(HaplyMessage, AsksForEverythingBesideItsForce) {
  EXPECT_EQ(
      message({0, 0, 0}, HaplyForceForm::vector, HaplyRequest::full_state),
      R"({"session":{"force_render_full_state":{}},)"
      R"("inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":0,"y":0,"z":0}}}}]})");
}

TEST(HaplyMessage, RoundsToAMicronewtonAndIsAlwaysJson) {
  const json said =
      json::parse(message({1.0 / 3.0, -1e-9, 1e-300}, HaplyForceForm::vector, HaplyRequest::nothing, "a\"b"));
  const json& device = said.at("inverse3").at(0);
  EXPECT_EQ(device.at("device_id"), "a\"b");
  const json& force = device.at("commands").at("set_cursor_force").at("vector");
  EXPECT_DOUBLE_EQ(force.at("x"), 0.333333);
  EXPECT_EQ(force.at("y"), 0.0);
  EXPECT_EQ(force.at("z"), 0.0);
}

/// The inventory of the service's documentation, with a grip.
const std::string inventory = R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3",
  "handedness":"right","basis":{"permutation":"XYZ"},"filters":{"force_gate":{"gain":0.3},"damping":{"scalar":0.0}}},
  "state":{"cursor_position":{"x":0.0,"y":-0.12,"z":0.15},"cursor_velocity":{"x":0,"y":0,"z":0},
  "body_orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0},"control_mode":"idle"},"status":{}},{"device_id":"1AB2"}],
  "wireless_verse_grip":[{"device_id":"61548","state":{"orientation":{"w":0.0,"x":1.0,"y":0.0,"z":0.0},
  "buttons":{"a":false,"b":true,"c":false}}}]})";

TEST(HaplyReader, TakesTheInventoryAndKeepsWhatFramesLeaveOut) {
  HaplyReader reader("", "");
  reader.take_inventory(inventory);
  EXPECT_EQ(reader.device().device_id, "049D");
  EXPECT_EQ(reader.device().grip_id, "61548");
  EXPECT_EQ(reader.device().position_m, Vec3(0, -0.12, 0.15));
  EXPECT_EQ(reader.device().orientation_wxyz, (std::array<double, 4>{0, 1, 0, 0}));
  EXPECT_TRUE(reader.device().has_buttons && reader.device().button_b && !reader.device().button_a);
  EXPECT_EQ(reader.device().force_scale, 1.0);
  std::string why;
  ASSERT_TRUE(reader.take_state(
      R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"z":0.2}}}],
          "wireless_verse_grip":[{"device_id":"61548","state":{"buttons":{"a":true}}}]})",
      why))
      << why;
  EXPECT_EQ(reader.device().position_m, Vec3(0, -0.12, 0.2));
  EXPECT_EQ(reader.device().orientation_wxyz, (std::array<double, 4>{0, 1, 0, 0}));
  EXPECT_TRUE(reader.device().button_a && reader.device().button_b);
}

TEST(HaplyReader, GoodForOtherGripsAndNone) {
  for (const char* kind : {"verse_grip", "custom_verse_grip", "wireless_verse_grip"}) {
    json frame = json::parse(inventory);
    const json grip = frame["wireless_verse_grip"];
    frame.erase("wireless_verse_grip");
    HaplyReader without("", "");
    without.take_inventory(frame.dump());
    EXPECT_FALSE(without.device().has_grip || without.device().has_buttons);
    frame[kind] = grip;
    HaplyReader with("", "");
    with.take_inventory(frame.dump());
    EXPECT_TRUE(with.device().has_grip) << kind;
  }
}

TEST(HaplyReader, ReadsTheScaleOfForces) {
  json frame = json::parse(inventory);
  for (const json& said : {json(0.5), json{{"gain", 0.5}}, json{{"scalar", 0.5}}}) {
    frame["inverse3"][0]["config"]["filters"]["force_scale"] = said;
    HaplyReader reader("", "");
    reader.take_inventory(frame.dump());
    EXPECT_EQ(reader.device().force_scale, 0.5) << said;
  }
}

TEST(HaplyReader, TakesTheScaleOfForcesFromAnyFrameWithAConfiguration) {
  HaplyReader reader("", "");
  reader.take_inventory(inventory);
  std::string why;
  const auto state = [](const char* config) {
    return std::string(R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{}},"config":)") +
           config + "}]}";
  };
  ASSERT_TRUE(reader.take_state(state(R"({"filters":{"force_scale":{"gain":3}}})"), why)) << why;
  EXPECT_EQ(reader.device().force_scale, 3.0);
  ASSERT_TRUE(reader.take_state(state(R"({"preset":"defaults"})"), why)) << why;
  EXPECT_EQ(reader.device().force_scale, 3.0) << "it says nothing of filters";
  ASSERT_TRUE(reader.take_state(state(R"({"filters":{}})"), why)) << why;
  EXPECT_EQ(reader.device().force_scale, 1.0);
}

TEST(HaplyReader, KnowsWhetherAFrameTellsOfItsGrip) {
  HaplyReader reader("", "");
  reader.take_inventory(inventory);
  EXPECT_TRUE(reader.device().grip_reported);
  std::string why;
  const auto told = [&](const char* grips) {
    const std::string state =
        std::string(R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{}}}])") + grips + "}";
    EXPECT_TRUE(reader.take_state(state, why)) << why;
    return reader.device().grip_reported;
  };
  EXPECT_FALSE(told(""));
  EXPECT_FALSE(told(R"(,"wireless_verse_grip":[])"));
  EXPECT_FALSE(told(R"(,"wireless_verse_grip":[{"device_id":"9"}])"));
  EXPECT_TRUE(told(R"(,"wireless_verse_grip":[{"device_id":"61548"}])"));
  EXPECT_FALSE(told(R"(,"wireless_verse_grip":[{"device_id":"61548","status":{"connected":false}}])"));
  EXPECT_FALSE(told(R"(,"wireless_verse_grip":[{"device_id":"61548"}])")) << "as it was last said";
  EXPECT_TRUE(told(R"(,"wireless_verse_grip":[{"device_id":"61548","status":{"connected":true}}])"));
  EXPECT_TRUE(reader.device().button_b);
  reader.release_buttons();
  EXPECT_FALSE(reader.device().button_b);
}

TEST(HaplyReader, SaysWhatIsMissing) {
  const auto take = [](const std::string& id, const std::string& grip, const std::string& text) {
    HaplyReader(id, grip).take_inventory(text);
  };
  expect_error(ErrorKind::unavailable, "no Inverse3; check", [&] { take("", "", R"({"inverse3":[]})"); });
  expect_error(ErrorKind::unavailable, "no Inverse3 'FFFF', but 049D, 1AB2",
               [&] { take("FFFF", "", inventory); });
  expect_error(ErrorKind::unavailable, "no grip '9'", [&] { take("", "9", inventory); });
  expect_error(ErrorKind::unavailable, "no inventory", [&] { take("", "", "hello"); });
}

TEST(HaplyReader, ChangesNothingByAFrameThatMakesNoSense) {
  HaplyReader reader("", "");
  reader.take_inventory(inventory);
  std::string why;
  for (const char* senseless :
       {"", "{", "7", R"({"inverse3":7})", R"({"inverse3":[]})",
        R"({"inverse3":[{"device_id":"1AB2","state":{}}]})", R"({"inverse3":[{"device_id":"049D"}]})",
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_velocity":{"x":1}}}]})",
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":7}}]})",
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":1,"y":null}}}]})",
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":"1"}}}]})",
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":1e999}}}]})",
        R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":1}}}],
            "wireless_verse_grip":[{"device_id":"61548","state":{"orientation":{"w":2}}}]})"}) {
    why.clear();
    EXPECT_FALSE(reader.take_state(senseless, why)) << senseless;
    EXPECT_FALSE(why.empty()) << senseless;
    EXPECT_EQ(reader.device().position_m, Vec3(0, -0.12, 0.15)) << senseless;
  }
}

TEST(HaplyEvent, TellsOfBrakesWarningsAndCables) {
  using Kind = HaplyEvent::Kind;
  const auto event = [](const std::string& name, const std::string& type, const std::string& id = "049D") {
    const json text = {{"name", name},
                       {"category", "device"},
                       {"level", "warning"},
                       {"data", {{"device_id", id}, {"safety_type", type}}},
                       {"message", "words"}};
    return read_haply_event(text.dump(), "049D");
  };
  EXPECT_EQ(event("device-safety-triggered", "ebrake_triggered").kind, Kind::brake_on);
  EXPECT_EQ(event("device-safety-triggered", "ebrake_released").kind, Kind::brake_off);
  EXPECT_EQ(event("device-safety-triggered", "stall_detected").kind, Kind::warning);
  EXPECT_NE(event("device-safety-triggered", "stall_detected").text.find("stall_detected: words"),
            std::string::npos);
  EXPECT_EQ(event("device-disconnected", "").kind, Kind::gone);
  EXPECT_EQ(event("device-disconnected", "", "1AB2").kind, Kind::nothing);
  EXPECT_EQ(event("device-connected", "").kind, Kind::nothing);
  EXPECT_EQ(read_haply_event("{", "049D").kind, Kind::nothing);
}

}  // namespace
}  // namespace ream::device
