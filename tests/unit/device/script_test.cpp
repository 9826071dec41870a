#include "device/script/script.hpp"

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
        "spindle_rpm": 200, "feed_model": "oblique", "specimen_factor": 0.95,
        "hand": {"start_mm": [1, 2, -9], "tilt_deg": [90, 0, 0], "mass_kg": 2, "arm_damping_n_s_mm": 0.5,
                 "guide_stiffness_n_mm": 7, "force_profile": [{"t_s": 0.5, "force_n": -8}]},
        "buttons": [{"t_s": 1}, {"t_s": 2, "spindle": false, "pause": true}]})"),
      "run.json");
  EXPECT_EQ(script.kind, ScriptKind::hand);
  EXPECT_EQ(script.duration_s, 3.5);
  EXPECT_EQ(script.force_scale, 26.0);
  EXPECT_EQ(script.stiffness_n_mm, 2.5);
  EXPECT_EQ(script.spindle_rpm, 200.0);
  EXPECT_EQ(script.feed_model, "oblique");
  EXPECT_EQ(script.specimen_factor, 0.95);
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

TEST(Script, ReadsHowAHandShakesReactsAndTurns) {
  json script = hand_script();
  script["device_profile"] = "hapticmaster";
  script["hand"].update({{"arm_stiffness_n_mm", 0.25},
                         {"tremor_rms_n", 1.5},
                         {"correction_gain", 0.5},
                         {"reaction_time_s", 0.125},
                         {"grip_stiffness_n_mm", 3.0},
                         {"grip_damping_n_s_mm", 0.0625},
                         {"wrist", {{"stiffness_n_mm_rad", 4000.0}, {"inertia_kg_mm2", 2000.0}}}});
  const Script read = parse_script(script, "run.json");
  EXPECT_EQ(read.device_profile, "hapticmaster");
  EXPECT_EQ(read.hand.arm_stiffness_n_mm, 0.25);
  EXPECT_EQ(read.hand.tremor_rms_n, 1.5);
  EXPECT_EQ(read.hand.correction_gain, 0.5);
  EXPECT_EQ(read.hand.reaction_time_s, 0.125);
  EXPECT_EQ(read.hand.grip_stiffness_n_mm, 3.0);
  EXPECT_EQ(read.hand.grip_damping_n_s_mm, 0.0625);
  ASSERT_TRUE(read.hand.wrist.has_value());
  EXPECT_EQ(read.hand.wrist->stiffness_n_mm_rad, 4000.0);
  EXPECT_EQ(read.hand.wrist->damping_n_mm_s_rad, Wrist{}.damping_n_mm_s_rad);
  EXPECT_EQ(read.hand.wrist->inertia_kg_mm2, 2000.0);
}

TEST(Script, LeftOutAHandNeitherShakesNorReactsNorTurns) {
  const Script script = parse_script(hand_script(), "run.json");
  EXPECT_EQ(script.device_profile, "ideal");
  EXPECT_EQ(script.hand.arm_stiffness_n_mm, 0.0);
  EXPECT_EQ(script.hand.tremor_rms_n, 0.0);
  EXPECT_EQ(script.hand.correction_gain, 0.0);
  EXPECT_FALSE(script.hand.wrist.has_value());
}

TEST(Script, ReadsARobot) {
  const Script script = parse_script(
      json::parse(
          R"({"device": "robot", "duration_s": 60, "robot": {"start_mm": [0, 0, -2], "tilt_deg": [0, 90, 0],
                      "approach_mm_s": 1, "force_n": 40, "ramp_s": 5, "depth_mm": 0.5,
                      "line_stiffness_n_mm": 200}})"),
      "run.json");
  EXPECT_EQ(script.kind, ScriptKind::robot);
  EXPECT_EQ(script.device_profile, "ideal-admittance");
  EXPECT_EQ(script.robot.start_mm, Vec3(0, 0, -2));
  EXPECT_NEAR(script.robot.tilt_rad.y(), pi / 2.0, 1e-15);
  EXPECT_EQ(script.robot.approach_mm_s, 1.0);
  EXPECT_EQ(script.robot.force_n, 40.0);
  EXPECT_EQ(script.robot.ramp_s, 5.0);
  EXPECT_EQ(script.robot.depth_mm, 0.5);
  EXPECT_EQ(script.robot.line_stiffness_n_mm, 200.0);
}

TEST(Script, AsksNoMoreOfADeviceThanItCan) {
  expect_refused(with(hand_script(), "/device_profile", "omega"),
                 "no device profile 'omega'; there are omega.3");
  json touch = with(hand_script(), "/device_profile", "touch");
  EXPECT_EQ(parse_script(touch, "run.json").stiffness_n_mm, 0.0);
  EXPECT_EQ(parse_script(with(touch, "/stiffness_n_mm", 0.4), "run.json").stiffness_n_mm, 0.4);
  expect_refused(with(touch, "/stiffness_n_mm", 0.5),
                 "key 'stiffness_n_mm' is 0.5, but touch renders at most 0.4");
  expect_refused(with(pose_script(), "/device_profile", "hapticmaster"),
                 "'device_profile' must be an impedance");
  const json robot = {{"device", "robot"}, {"duration_s", 1.0}, {"robot", json::object()}};
  expect_refused(with(robot, "/device_profile", "omega.3"), "'device_profile' must be an admittance");
}

TEST(Script, ReadsHowTheReamerVibrates) {
  EXPECT_EQ(parse_script(hand_script(), "run.json").vibration.source, "synthesized");
  EXPECT_EQ(parse_script(with(hand_script(), "/vibration", {{"source", "off"}, {"n_per_g", 0.3}}), "run.json")
                .vibration.n_per_g,
            0.3);
  const json recording = {{"source", "recording"},
                          {"cortical_file", "hard.wav"},
                          {"cancellous_file", "/somewhere/soft.csv"},
                          {"rate_hz", 2000}};
  const test::TemporaryFolder folder;
  const auto file = folder.write("scripts/run.json", with(hand_script(), "/vibration", recording).dump());
  const ScriptVibration vibration = load_script(file).vibration;
  EXPECT_EQ(vibration.source, "recording");
  EXPECT_EQ(vibration.cortical_file, folder.path() / "scripts" / "hard.wav");
  EXPECT_EQ(vibration.cancellous_file, "/somewhere/soft.csv");
  EXPECT_TRUE(vibration.idle_file.empty());
  EXPECT_EQ(vibration.rate_hz, 2000.0);
}

TEST(Script, RefusesAVibrationThatCannotBeMade) {
  const auto refused = [](const json& vibration, const std::string& mentioned) {
    expect_refused(with(hand_script(), "/vibration", vibration), mentioned);
  };
  refused({{"source", "loud"}}, "run.json.vibration: key 'source' must be");
  refused({{"source", "recording"}, {"cortical_file", "a.wav"}}, "'cancellous_file' is missing");
  refused({{"cortical_file", "a.wav"}}, "'cortical_file' is unknown");
  refused({{"n_per_g", -0.1}}, "'n_per_g'");
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
  for (const char* pointer :
       {"/durtion_s", "/hand/mass_g", "/hand/wrist/mass_kg", "/hand/force_profile/1/force_kn", "/poses"}) {
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
  expect_refused(with(hand_script(), "/feed_model", "rubbing"), "'feed_model' must be 'edge'");
  expect_refused(with(hand_script(), "/hand", 7), "run.json.hand");
  expect_refused(with(hand_script(), "/hand/start_mm", {1, 2}), "'start_mm' must be a list of 3 numbers");
  expect_refused(with(hand_script(), "/hand/start_mm", {1, 2, "3"}), "'start_mm'");
  expect_refused(with(hand_script(), "/hand/start_mm", {1e9, 0, 5}), "'start_mm' must be within");
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
  expect_refused(with(hand_script(), "/mount", "table"),
                 "'mount' must be 'rigid', 'chest_wall' or an object");
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
