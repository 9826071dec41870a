#include "device/script.hpp"

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/json_reader.hpp"
#include "core/units.hpp"

namespace ream::device {
namespace {

constexpr double longest_script_s = 4.0 * 3600.0;

Vec3 vector_or(JsonReader& reader, const std::string& key, const Vec3& fallback, double scale = 1.0) {
  if (!reader.has(key)) return fallback;
  const auto v = reader.numbers(key, 3);
  return Vec3(v[0], v[1], v[2]) * scale;
}

/// The entry's t_s, which must be later than the one before.
double next_time(JsonReader& entry, double previous_s) {
  const double t_s = entry.number("t_s", 0.0, longest_script_s);
  if (t_s <= previous_s) entry.refuse("t_s", "must be later than the entry before it");
  return t_s;
}

HandParameters parse_hand(JsonReader reader) {
  HandParameters hand;
  hand.start_mm = vector_or(reader, "start_mm", hand.start_mm);
  hand.tilt_rad = vector_or(reader, "tilt_deg", hand.tilt_rad, radians_from_degrees(1.0));
  hand.mass_kg = reader.number_or("mass_kg", hand.mass_kg, 0.05, 100.0);
  hand.arm_damping_n_s_mm = reader.number_or("arm_damping_n_s_mm", hand.arm_damping_n_s_mm, 0.0, 100.0);
  hand.guide_stiffness_n_mm = reader.number_or("guide_stiffness_n_mm", hand.guide_stiffness_n_mm, 0.0, 100.0);
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
    entry.finish();
    buttons.push_back(b);
  }
  return buttons;
}

Vec3 positive_vector(JsonReader& reader, const std::string& key, bool may_be_zero) {
  const auto v = reader.numbers(key, 3);
  for (const double x : v)
    if (!(may_be_zero ? x >= 0.0 : x > 0.0))
      reader.refuse(key, may_be_zero ? "must not be negative" : "must be above 0");
  return {v[0], v[1], v[2]};
}

ScapulaMount parse_mount(JsonReader reader) {
  ScapulaMount mount;
  mount.stiffness_n_mm = positive_vector(reader, "stiffness_n_mm", false);
  mount.damping_n_s_mm = positive_vector(reader, "damping_n_s_mm", true);
  mount.angular_stiffness_n_mm_rad = positive_vector(reader, "angular_stiffness_n_mm_rad", false);
  mount.angular_damping_n_mm_s_rad = positive_vector(reader, "angular_damping_n_mm_s_rad", true);
  reader.finish();
  return mount;
}

/// "rigid", "chest_wall", or an object with all its numbers.
std::optional<ScapulaMount> mount_or_rigid(const nlohmann::json& json, JsonReader& reader) {
  if (!reader.has("mount")) return std::nullopt;
  if (!json.at("mount").is_string()) return parse_mount(reader.object("mount"));
  const std::string word = reader.text("mount");
  if (word == "rigid") return std::nullopt;
  if (word != "chest_wall") reader.refuse("mount", "must be 'rigid', 'chest_wall' or an object");
  return chest_wall_mount;
}

}  // namespace

Script parse_script(const nlohmann::json& json, const std::string& where) {
  JsonReader reader(json, where);
  Script script;
  const std::string kind = reader.text("device");
  if (kind != "hand" && kind != "poses") reader.refuse("device", "must be 'hand' or 'poses'");
  script.kind = kind == "hand" ? ScriptKind::hand : ScriptKind::poses;
  script.duration_s = reader.number("duration_s", 0.001, longest_script_s);
  script.force_scale = reader.number_or("force_scale", script.force_scale, 0.01, 1000.0);
  script.stiffness_n_mm = reader.number_or("stiffness_n_mm", script.stiffness_n_mm, 0.0, 1000.0);
  script.spindle_rpm = reader.number_or("spindle_rpm", script.spindle_rpm, 1.0, 2000.0);
  script.mount = mount_or_rigid(json, reader);
  if (script.kind == ScriptKind::hand) script.hand = parse_hand(reader.object("hand"));
  if (script.kind == ScriptKind::poses) script.poses = parse_poses(reader);
  if (reader.has("buttons")) script.buttons = parse_buttons(reader);
  reader.finish();
  return script;
}

Script load_script(const std::filesystem::path& path) {
  return parse_script(read_json_file(path), path.string());
}

}  // namespace ream::device
