#include "device/script_mount.hpp"

#include "core/json.hpp"
#include "core/json_reader.hpp"

namespace ream::device {
namespace {

Vec3 numbers_above(JsonReader& reader, const std::string& key, bool may_be_zero) {
  const auto v = reader.numbers(key, 3);
  for (const double x : v)
    if (!(may_be_zero ? x >= 0.0 : x > 0.0))
      reader.refuse(key, may_be_zero ? "must not be negative" : "must be above 0");
  return {v[0], v[1], v[2]};
}

}  // namespace

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

}  // namespace ream::device
