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
  if (script.kind == ScriptKind::hand) script.hand = parse_hand(reader.object("hand"));
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

}  // namespace ream::device
