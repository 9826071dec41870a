#include "device/script.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::device {
namespace {

using nlohmann::json;
using test::expect_error;

json hand_script() {
  return {
      {"device", "hand"},
      {"duration_s", 2.0},
      {"hand", {{"force_profile", {{{"t_s", 0.0}, {"force_n", 0.0}}, {{"t_s", 1.0}, {"force_n", 40.0}}}}}}};
}

json pose_script() {
  return {
      {"device", "poses"},
      {"duration_s", 2.0},
      {"poses", {{{"t_s", 0.0}, {"position_mm", {0, 0, -5}}}, {{"t_s", 1.0}, {"position_mm", {0, 0, 2}}}}}};
}

void expect_refused(const json& script, const std::string& mentioned) {
  expect_error(ErrorKind::invalid_input, mentioned, [&] { parse_script(script, "run.json"); });
}

/// The script with the value at `pointer` replaced (or added).
json with(json script, const std::string& pointer, const json& value) {
  script[json::json_pointer(pointer)] = value;
  return script;
}

TEST(Script, ReadsEveryKeyOfAHand) {
  const Script script = parse_script(
      json::parse(R"({"device": "hand", "duration_s": 3.5, "force_scale": 26, "stiffness_n_mm": 2.5,
        "spindle_rpm": 200,
        "hand": {"start_mm": [1, 2, -9], "tilt_deg": [90, 0, 0], "mass_kg": 2, "arm_damping_n_s_mm": 0.5,
                 "guide_stiffness_n_mm": 7, "force_profile": [{"t_s": 0.5, "force_n": -8}]},
        "buttons": [{"t_s": 1}, {"t_s": 2, "spindle": false, "pause": true}]})"),
      "run.json");
  EXPECT_EQ(script.kind, ScriptKind::hand);
  EXPECT_EQ(script.duration_s, 3.5);
  EXPECT_EQ(script.force_scale, 26.0);
  EXPECT_EQ(script.stiffness_n_mm, 2.5);
  EXPECT_EQ(script.spindle_rpm, 200.0);
  EXPECT_EQ(script.hand.start_mm, Vec3(1, 2, -9));
  EXPECT_NEAR(script.hand.tilt_rad.x(), pi / 2.0, 1e-15);
  EXPECT_EQ(script.hand.mass_kg, 2.0);
  EXPECT_EQ(script.hand.arm_damping_n_s_mm, 0.5);
  EXPECT_EQ(script.hand.guide_stiffness_n_mm, 7.0);
  ASSERT_EQ(script.hand.force_profile.size(), 1u);
  EXPECT_EQ(script.hand.force_profile[0].t_s, 0.5);
  EXPECT_EQ(script.hand.force_profile[0].force_n, -8.0);
  ASSERT_EQ(script.buttons.size(), 2u);
  EXPECT_TRUE(script.buttons[0].spindle);
  EXPECT_FALSE(script.buttons[0].pause);
  EXPECT_FALSE(script.buttons[1].spindle);
  EXPECT_TRUE(script.buttons[1].pause);
}

TEST(Script, ReadsPosesInDegrees) {
  const Script script =
      parse_script(with(pose_script(), "/poses/1/rotation_deg", {0.0, 0.0, 30.0}), "run.json");
  EXPECT_EQ(script.kind, ScriptKind::poses);
  ASSERT_EQ(script.poses.size(), 2u);
  EXPECT_EQ(script.poses[0].rotation_vector_rad, Vec3(0, 0, 0));
  EXPECT_EQ(script.poses[1].position_mm, Vec3(0, 0, 2));
  EXPECT_NEAR(script.poses[1].rotation_vector_rad.z(), pi / 6.0, 1e-15);
}

TEST(Script, UnknownKeysAreRefusedByName) {
  for (const char* pointer : {"/durtion_s", "/hand/mass_g", "/hand/force_profile/1/force_kn", "/poses"}) {
    const std::string key = json::json_pointer(pointer).back();
    expect_refused(with(hand_script(), pointer, 1.0), "key '" + key + "' is unknown");
  }
  expect_refused(with(pose_script(), "/poses/0/positon_mm", {0, 0, 0}), "key 'positon_mm' is unknown");
  expect_refused(with(pose_script(), "/hand", json::object()), "key 'hand' is unknown");
  expect_refused(with(hand_script(), "/buttons", json::parse(R"([{"t_s": 0, "paused": true}])")),
                 "key 'paused' is unknown");
}

TEST(Script, WrongTypesAndRangesAreRefusedByPlaceAndKey) {
  expect_refused(json::array(), "run.json must be a JSON object");
  expect_refused(with(hand_script(), "/device", "foot"), "'device'");
  expect_refused(with(hand_script(), "/device", 3), "'device'");
  expect_refused(with(hand_script(), "/duration_s", "long"), "'duration_s' must be a number");
  expect_refused(with(hand_script(), "/duration_s", 0.0), "'duration_s' is 0");
  expect_refused(with(hand_script(), "/duration_s", -1.0), "'duration_s'");
  expect_refused(with(hand_script(), "/force_scale", 0.0), "'force_scale'");
  expect_refused(with(hand_script(), "/hand", 7), "run.json.hand");
  expect_refused(with(hand_script(), "/hand/start_mm", {1, 2}), "'start_mm' must be a list of 3 numbers");
  expect_refused(with(hand_script(), "/hand/start_mm", {1, 2, "3"}), "'start_mm'");
  expect_refused(with(hand_script(), "/hand/mass_kg", 0.0), "'mass_kg'");
  expect_refused(with(hand_script(), "/hand/force_profile", json::array()), "'force_profile'");
  expect_refused(with(hand_script(), "/hand/force_profile/0/force_n", true),
                 "run.json.hand.force_profile[0]");
  expect_refused(with(hand_script(), "/buttons", json::parse(R"([{"t_s": 0, "pause": 1}])")),
                 "'pause' must be true or false");
  expect_refused(with(pose_script(), "/poses", json::object()), "'poses' must be a list");
  expect_refused(with(pose_script(), "/poses", json::array()), "'poses'");
}

TEST(Script, MountIsRigidUnlessItIsAskedFor) {
  EXPECT_FALSE(parse_script(hand_script(), "run.json").mount);
  EXPECT_FALSE(parse_script(with(hand_script(), "/mount", "rigid"), "run.json").mount);
  const auto chest_wall = parse_script(with(hand_script(), "/mount", "chest_wall"), "run.json").mount;
  ASSERT_TRUE(chest_wall);
  EXPECT_EQ(chest_wall->stiffness_n_mm, chest_wall_mount.stiffness_n_mm);
  const json own = {{"stiffness_n_mm", {1, 2, 3}},
                    {"damping_n_s_mm", {0, 0.5, 1}},
                    {"angular_stiffness_n_mm_rad", {4, 5, 6}},
                    {"angular_damping_n_mm_s_rad", {7, 8, 9}}};
  const auto mount = parse_script(with(hand_script(), "/mount", own), "run.json").mount;
  ASSERT_TRUE(mount);
  EXPECT_EQ(mount->stiffness_n_mm, Vec3(1, 2, 3));
  EXPECT_EQ(mount->damping_n_s_mm, Vec3(0, 0.5, 1));
  EXPECT_EQ(mount->angular_stiffness_n_mm_rad, Vec3(4, 5, 6));
  EXPECT_EQ(mount->angular_damping_n_mm_s_rad, Vec3(7, 8, 9));
  expect_refused(with(hand_script(), "/mount", "table"), "'mount' must be 'rigid', 'chest_wall' or an object");
  expect_refused(with(with(hand_script(), "/mount", own), "/mount/stiffness_n_mm/1", 0), "run.json.mount");
}

TEST(Script, MissingKeysAreNamed) {
  for (const char* key : {"device", "duration_s", "hand"}) {
    json script = hand_script();
    script.erase(key);
    expect_refused(script, std::string("key '") + key + "' is missing");
  }
  json script = pose_script();
  script["poses"][1].erase("t_s");
  expect_refused(script, "run.json.poses[1]: key 't_s' is missing");
}

TEST(Script, TimesMustAscend) {
  const auto at = [](double t_s) { return json({{"t_s", t_s}}); };
  for (const double late : {0.0, -1.0}) {
    expect_refused(with(hand_script(), "/hand/force_profile/1/t_s", late), "force_profile[1]: key 't_s'");
    expect_refused(with(pose_script(), "/poses/1/t_s", late), "poses[1]: key 't_s'");
    expect_refused(with(hand_script(), "/buttons", json::array({at(0.0), at(late)})),
                   "buttons[1]: key 't_s'");
  }
}

TEST(Script, NumbersMustBeFinite) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    expect_refused(with(hand_script(), "/duration_s", value), "'duration_s'");
    expect_refused(with(hand_script(), "/hand/force_profile/0/force_n", value), "'force_n'");
    expect_refused(with(hand_script(), "/hand/start_mm/1", value), "'start_mm'");
    expect_refused(with(pose_script(), "/poses/0/t_s", value), "'t_s'");
    expect_refused(with(pose_script(), "/poses/0/position_mm/2", value), "'position_mm'");
  }
}

TEST(Script, FilesThatAreNoScriptAreNamed) {
  const test::TemporaryFolder folder;
  expect_error(ErrorKind::not_found, "absent.json", [&] { load_script(folder.path() / "absent.json"); });
  for (const char* text : {"", "{\"device\": NaN}", "{\"duration_s\": 1e999}", "\xff\xfe", "{}]"}) {
    const auto file = folder.write("broken.json", text);
    expect_error(ErrorKind::invalid_input, "broken.json", [&] { load_script(file); });
  }
  const auto file = folder.write("good.json", hand_script().dump());
  EXPECT_EQ(load_script(file).duration_s, 2.0);
}

TEST(DemoScript, PushesIntoTheBoneAndLetsGoBeforeItEnds) {
  const Script script = demo_script();
  EXPECT_EQ(script.kind, ScriptKind::hand);
  EXPECT_LT(script.hand.start_mm.z(), 0.0) << "it begins outside the bone";
  ASSERT_FALSE(script.hand.force_profile.empty());
  double previous_s = -1.0, strongest_n = 0.0;
  for (const TimedForce& entry : script.hand.force_profile) {
    EXPECT_GT(entry.t_s, previous_s);
    EXPECT_LE(std::abs(entry.force_n), 500.0);
    previous_s = entry.t_s;
    strongest_n = std::max(strongest_n, entry.force_n);
  }
  EXPECT_GT(strongest_n, 0.0);
  EXPECT_LT(script.hand.force_profile.back().force_n, 0.0);
  EXPECT_LE(previous_s, script.duration_s);
}

}  // namespace
}  // namespace ream::device
