#include "device/script/script.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/json_reader.hpp"
#include "core/units.hpp"
#include "device/profiles.hpp"
#include "force/edge_load.hpp"
#include "force/feed_model.hpp"

namespace ream::device {
namespace {

Vec3 numbers_above(JsonReader& reader, const std::string& key, bool may_be_zero) {
  const auto v = reader.numbers(key, 3);
  for (const double x : v)
    if (!(may_be_zero ? x >= 0.0 : x > 0.0))
      reader.refuse(key, may_be_zero ? "must not be negative" : "must be above 0");
  return {v[0], v[1], v[2]};
}

constexpr double min_rate_hz = 1000.0, max_rate_hz = 1.0e6, max_n_per_g = 20.0;

void parse_recordings(JsonReader& reader, ScriptVibration& vibration) {
  const auto file = [&](const std::string& key) {
    const std::string name = reader.text(key);
    if (name.empty()) reader.refuse(key, "must name a .wav or .csv file");
    return name;
  };
  vibration.cortical_file = file("cortical_file");
  vibration.cancellous_file = file("cancellous_file");
  if (reader.has("idle_file")) vibration.idle_file = file("idle_file");
  if (reader.has("rate_hz")) vibration.rate_hz = reader.number("rate_hz", min_rate_hz, max_rate_hz);
}

constexpr double max_script_s = 4.0 * 3600.0;

/// Farther, in mm or degrees, no place or turn in a script makes sense.
constexpr double max_component = 1000.0;

Vec3 vector_or(JsonReader& reader, const std::string& key, const Vec3& fallback, double scale = 1.0) {
  if (!reader.has(key)) return fallback;
  const auto v = reader.numbers(key, 3);
  for (const double component : v)
    if (std::abs(component) > max_component) reader.refuse(key, "must be within -1000 and 1000");
  return Vec3(v[0], v[1], v[2]) * scale;
}

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// The entry's t_s, which must be later than the one before.
double next_time(JsonReader& entry, double previous_s) {
  const double t_s = entry.number("t_s", 0.0, max_script_s);
  if (t_s <= previous_s) entry.refuse("t_s", "must be later than the entry before it");
  return t_s;
}

Wrist parse_wrist(JsonReader reader) {
  Wrist wrist;
  wrist.stiffness_n_mm_rad = reader.number_or("stiffness_n_mm_rad", wrist.stiffness_n_mm_rad, 0.0, 1.0e6);
  wrist.damping_n_mm_s_rad = reader.number_or("damping_n_mm_s_rad", wrist.damping_n_mm_s_rad, 0.0, 1.0e5);
  wrist.inertia_kg_mm2 = reader.number_or("inertia_kg_mm2", wrist.inertia_kg_mm2, 100.0, 1.0e6);
  reader.finish();
  return wrist;
}

HandParameters parse_hand(JsonReader reader) {
  HandParameters hand;
  hand.start_mm = vector_or(reader, "start_mm", hand.start_mm);
  hand.tilt_rad = vector_or(reader, "tilt_deg", hand.tilt_rad, radians_from_degrees(1.0));
  hand.mass_kg = reader.number_or("mass_kg", hand.mass_kg, 0.05, 100.0);
  hand.arm_damping_n_s_mm = reader.number_or("arm_damping_n_s_mm", hand.arm_damping_n_s_mm, 0.0, 100.0);
  hand.guide_stiffness_n_mm = reader.number_or("guide_stiffness_n_mm", hand.guide_stiffness_n_mm, 0.0, 100.0);
  hand.arm_stiffness_n_mm = reader.number_or("arm_stiffness_n_mm", hand.arm_stiffness_n_mm, 0.0, 100.0);
  hand.tremor_rms_n = reader.number_or("tremor_rms_n", hand.tremor_rms_n, 0.0, 50.0);
  hand.correction_gain = reader.number_or("correction_gain", hand.correction_gain, 0.0, 0.95);
  hand.reaction_time_s = reader.number_or("reaction_time_s", hand.reaction_time_s, 0.001, 1.0);
  hand.grip_stiffness_n_mm = reader.number_or("grip_stiffness_n_mm", hand.grip_stiffness_n_mm, 0.1, 20.0);
  hand.grip_damping_n_s_mm = reader.number_or("grip_damping_n_s_mm", hand.grip_damping_n_s_mm, 0.0, 0.2);
  if (reader.has("wrist")) hand.wrist = parse_wrist(reader.object("wrist"));
  double previous_s = -1.0;
  for (JsonReader& entry : reader.objects("force_profile")) {
    previous_s = next_time(entry, previous_s);
    hand.force_profile.push_back({previous_s, entry.number("force_n", -500.0, 500.0)});
    entry.finish();
  }
  if (hand.force_profile.empty()) reader.refuse("force_profile", "must have at least one entry");
  reader.finish();
  return hand;
}

RobotParameters parse_robot(JsonReader reader) {
  RobotParameters robot;
  robot.start_mm = vector_or(reader, "start_mm", robot.start_mm);
  robot.tilt_rad = vector_or(reader, "tilt_deg", robot.tilt_rad, radians_from_degrees(1.0));
  robot.approach_mm_s = reader.number_or("approach_mm_s", robot.approach_mm_s, 0.1, 50.0);
  robot.force_n = reader.number_or("force_n", robot.force_n, 1.0, 500.0);
  robot.ramp_s = reader.number_or("ramp_s", robot.ramp_s, 0.1, 60.0);
  robot.depth_mm = reader.number_or("depth_mm", robot.depth_mm, 0.01, 50.0);
  robot.line_stiffness_n_mm = reader.number_or("line_stiffness_n_mm", robot.line_stiffness_n_mm, 1.0, 1000.0);
  reader.finish();
  return robot;
}

std::vector<TimedPose> parse_poses(JsonReader& reader) {
  std::vector<TimedPose> poses;
  double previous_s = -1.0;
  for (JsonReader& entry : reader.objects("poses")) {
    TimedPose pose;
    pose.t_s = previous_s = next_time(entry, previous_s);
    pose.position_mm = vector_or(entry, "position_mm", pose.position_mm);
    pose.rotation_vector_rad =
        vector_or(entry, "rotation_deg", pose.rotation_vector_rad, radians_from_degrees(1.0));
    entry.finish();
    poses.push_back(pose);
  }
  if (poses.empty()) reader.refuse("poses", "must have at least one entry");
  return poses;
}

std::vector<TimedButtons> parse_buttons(JsonReader& reader) {
  std::vector<TimedButtons> buttons;
  double previous_s = -1.0;
  for (JsonReader& entry : reader.objects("buttons")) {
    TimedButtons b;
    b.t_s = previous_s = next_time(entry, previous_s);
    b.spindle = entry.boolean_or("spindle", true);
    b.pause = entry.boolean_or("pause", false);
    b.drive.trigger = static_cast<uint8_t>(std::lround(255.0 * entry.number_or("trigger", 1.0, 0.0, 1.0)));
    b.drive.reversed = entry.boolean_or("reverse", false);
    b.drive.irrigating = entry.boolean_or("irrigate", false);
    entry.finish();
    buttons.push_back(b);
  }
  return buttons;
}

ScriptKind parse_kind(JsonReader& reader) {
  const std::string kind = reader.text("device");
  if (kind == "hand") return ScriptKind::hand;
  if (kind == "poses") return ScriptKind::poses;
  if (kind == "robot") return ScriptKind::robot;
  reader.refuse("device", "must be 'hand', 'poses' or 'robot'");
}

/// Which device plays the script, and what that device cannot do.
void parse_profile(JsonReader& reader, Script& script) {
  const bool robot = script.kind == ScriptKind::robot;
  script.device_profile = reader.text_or("device_profile", robot ? "ideal-admittance" : "ideal");
  DeviceTraits traits;
  try {
    traits = device_profile(script.device_profile);
  } catch (const Error& e) {
    reader.refuse("device_profile", std::string("is wrong: ") + e.what());
  }
  const bool gives_force = traits.causality == Causality::admittance;
  if (robot && !gives_force)
    reader.refuse("device_profile", "must be an admittance device for a robot, such as 'ideal-admittance'");
  if (script.kind == ScriptKind::poses && gives_force)
    reader.refuse("device_profile", "must be an impedance device for timed poses, such as 'ideal'");
  if (script.stiffness_n_mm > traits.stiffness_max_n_mm)
    reader.refuse("stiffness_n_mm", "is " + text_of(script.stiffness_n_mm) + ", but " +
                                        script.device_profile + " renders at most " +
                                        text_of(traits.stiffness_max_n_mm) + "; 0 takes the most it can");
}

/// Index of the first entry later than t.
template <typename T>
size_t first_after(const std::vector<T>& entries, double t_s) {
  return static_cast<size_t>(std::upper_bound(entries.begin(), entries.end(), t_s,
                                              [](double t, const T& entry) { return t < entry.t_s; }) -
                             entries.begin());
}

/// The key "mount", whose value is `value`: "rigid" (empty), "chest_wall", or an object with all its numbers.
std::optional<ScapulaMount> parse_mount(const nlohmann::json& value, JsonReader& script) {
  if (value.is_string()) {
    const std::string word = script.text("mount");
    if (word == "rigid") return std::nullopt;
    if (word != "chest_wall") script.refuse("mount", "must be 'rigid', 'chest_wall' or an object");
    return chest_wall_mount;
  }
  JsonReader reader = script.object("mount");
  ScapulaMount mount;
  mount.stiffness_n_mm = numbers_above(reader, "stiffness_n_mm", false);
  mount.damping_n_s_mm = numbers_above(reader, "damping_n_s_mm", true);
  mount.angular_stiffness_n_mm_rad = numbers_above(reader, "angular_stiffness_n_mm_rad", false);
  mount.angular_damping_n_mm_s_rad = numbers_above(reader, "angular_damping_n_mm_s_rad", true);
  reader.finish();
  return mount;
}

ScriptVibration parse_vibration(JsonReader reader) {
  ScriptVibration vibration;
  vibration.source = reader.text_or("source", vibration.source);
  if (vibration.source != "synthesized" && vibration.source != "recording" && vibration.source != "off")
    reader.refuse("source", "must be 'synthesized', 'recording' or 'off'");
  if (vibration.source == "recording") parse_recordings(reader, vibration);
  if (reader.has("n_per_g")) vibration.n_per_g = reader.number("n_per_g", 0.0, max_n_per_g);
  reader.finish();
  return vibration;
}

/// The key "drive": "ideal" (empty), or an object.
std::optional<force::SpindleSettings> parse_drive(const nlohmann::json& value, JsonReader& script) {
  if (value.is_string()) {
    if (script.text("drive") != "ideal") script.refuse("drive", "must be 'ideal' or an object");
    return std::nullopt;
  }
  JsonReader reader = script.object("drive");
  force::SpindleSettings drive;
  drive.stall_torque_n_mm = reader.number_or("stall_torque_n_mm", drive.stall_torque_n_mm, 100.0, 100'000.0);
  drive.droop_rad_s_per_n_mm =
      reader.number_or("droop_rad_s_per_n_mm", drive.droop_rad_s_per_n_mm, 1e-5, 0.1);
  drive.inertia_kg_mm2 = reader.number_or("inertia_kg_mm2", drive.inertia_kg_mm2, 100.0, 100'000.0);
  drive.start_s = reader.number_or("start_s", drive.start_s, 0.001, 5.0);
  drive.coast_s = reader.number_or("coast_s", drive.coast_s, 0.001, 5.0);
  drive.mass_kg = reader.number_or("mass_kg", drive.mass_kg, 0.05, 10.0);
  drive.catch_ratio = reader.number_or("catch_ratio", drive.catch_ratio, 1.0, 20.0);
  reader.finish();
  return drive;
}

}  // namespace

void ScriptVibration::resolve(const std::filesystem::path& folder) {
  for (std::filesystem::path* file : {&cortical_file, &cancellous_file, &idle_file})
    if (!file->empty()) *file = folder / *file;
}

Script parse_script(const nlohmann::json& json, const std::string& where) {
  JsonReader reader(json, where);
  Script script;
  script.kind = parse_kind(reader);
  script.duration_s = reader.number("duration_s", 0.001, max_script_s);
  script.force_scale = reader.number_or("force_scale", script.force_scale, 0.01, 1000.0);
  script.stiffness_n_mm = reader.number_or("stiffness_n_mm", script.stiffness_n_mm, 0.0, 100.0);
  parse_profile(reader, script);
  script.spindle_rpm = reader.number_or("spindle_rpm", script.spindle_rpm, 1.0, 2000.0);
  script.feed_model = reader.text_or("feed_model", script.feed_model);
  if (!force::find_feed_kind(script.feed_model))
    reader.refuse("feed_model", "must be " + force::feed_model_names("'"));
  script.specimen_factor = reader.number_or("specimen_factor", script.specimen_factor, 0.1, 10.0);
  if (reader.has("cutting")) script.cutting = force::cutting_from_json(reader.object("cutting"));
  if (reader.has("drive")) script.drive = parse_drive(json.at("drive"), reader);
  if (reader.has("mount")) script.mount = parse_mount(json.at("mount"), reader);
  if (script.kind == ScriptKind::hand) script.hand = parse_hand(reader.object("hand"));
  if (script.kind == ScriptKind::robot) script.robot = parse_robot(reader.object("robot"));
  if (script.kind == ScriptKind::poses) script.poses = parse_poses(reader);
  if (reader.has("vibration")) script.vibration = parse_vibration(reader.object("vibration"));
  if (reader.has("buttons")) script.buttons = parse_buttons(reader);
  reader.finish();
  return script;
}

Script load_script(const std::filesystem::path& path) {
  Script script = parse_script(read_json_file(path), path.string());
  script.vibration.resolve(path.parent_path());
  return script;
}

double force_at(const std::vector<TimedForce>& profile, double t_s) noexcept {
  if (profile.empty()) return 0.0;
  const size_t next = first_after(profile, t_s);
  if (next == 0) return profile.front().force_n;
  if (next == profile.size()) return profile.back().force_n;
  const TimedForce &a = profile[next - 1], &b = profile[next];
  return a.force_n + (b.force_n - a.force_n) * ((t_s - a.t_s) / (b.t_s - a.t_s));
}

TimedPose pose_at(const std::vector<TimedPose>& poses, double t_s) noexcept {
  const size_t next = first_after(poses, t_s);
  if (next == 0) return poses.front();
  if (next == poses.size()) return poses.back();
  const TimedPose &a = poses[next - 1], &b = poses[next];
  const double s = (t_s - a.t_s) / (b.t_s - a.t_s);
  return {t_s, a.position_mm + s * (b.position_mm - a.position_mm),
          a.rotation_vector_rad + s * (b.rotation_vector_rad - a.rotation_vector_rad)};
}

TimedButtons buttons_at(const std::vector<TimedButtons>& buttons, double t_s) noexcept {
  const size_t next = first_after(buttons, t_s);
  return next == 0 ? TimedButtons{} : buttons[next - 1];
}

}  // namespace ream::device
