#include "sim/settings.hpp"

#include <algorithm>
#include <concepts>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "core/error.hpp"
#include "core/json_reader.hpp"
#include "core/units.hpp"

namespace ream::sim {
namespace {

using nlohmann::json;

class Writer {
 public:
  void field(const char* key, double value) { json_[key] = value; }
  void field(const char* key, int value) { json_[key] = value; }
  void field(const char* key, uint64_t value) { json_[key] = value; }
  void field(const char* key, bool value) { json_[key] = value; }
  void field(const char* key, const Vec3& v) { json_[key] = {v.x(), v.y(), v.z()}; }
  void field(const char* key, const std::filesystem::path& value) { json_[key] = value.string(); }
  void field(const char* key, const std::string& value) { json_[key] = value; }
  void field(const char* key, RemovalLaw value) { json_[key] = to_text(value); }
  void field(const char* key, force::FeedKind value) { json_[key] = force::to_text(value); }
  void field(const char* key, force::VibrationSource value) { json_[key] = force::to_text(value); }
  template <typename Part>
  void part(const char* key, const Part& value) {
    Writer writer;
    for_each_field(writer, value);
    json_[key] = writer.take();
  }
  template <typename Part>
  void part(const char* key, const std::optional<Part>& value) {
    json_[key] = nullptr;
    if (value) part(key, *value);
  }
  /// Nothing where there is nothing, as earlier versions wrote it.
  template <typename Part>
  void rare_part(const char* key, const std::optional<Part>& value) {
    if (value) part(key, *value);
  }
  json take() { return std::move(json_); }

 private:
  json json_ = json::object();
};

class Reader {
 public:
  Reader(const json& value, const std::string& place) : value_(value), reader_(value, place) {}

  void field(const char* key, double& value) {
    if (reader_.has(key)) value = reader_.number(key);
  }
  void field(const char* key, int& value) {
    if (reader_.has(key)) value = static_cast<int>(reader_.integer(key, 0, INT32_MAX));
  }
  void field(const char* key, uint64_t& value) {
    if (reader_.has(key)) value = reader_.unsigned_integer(key);
  }
  void field(const char* key, bool& value) { value = reader_.boolean_or(key, value); }
  void field(const char* key, Vec3& value) {
    if (!reader_.has(key)) return;
    const auto numbers = reader_.numbers(key, 3);
    value = {numbers[0], numbers[1], numbers[2]};
  }
  void field(const char* key, std::filesystem::path& value) { value = reader_.text_or(key, value.string()); }
  void field(const char* key, std::string& value) { value = reader_.text_or(key, value); }
  void field(const char* key, RemovalLaw& value) {
    if (reader_.has(key)) value = word(key, removal_law_from_text);
  }
  void field(const char* key, force::FeedKind& value) {
    if (reader_.has(key)) value = word(key, force::feed_kind_from_text);
  }
  void field(const char* key, force::VibrationSource& value) {
    if (reader_.has(key)) value = word(key, force::vibration_source_from);
  }
  template <typename Part>
  void part(const char* key, Part& value) {
    if (!reader_.has(key)) return;
    Reader reader(value_.at(key), reader_.place() + "." + key);
    for_each_field(reader, value);
    reader.finish();
  }
  template <typename Part>
  void part(const char* key, std::optional<Part>& value) {
    value.reset();
    if (reader_.has(key) && !value_.at(key).is_null()) part(key, value.emplace());
  }
  template <typename Part>
  void rare_part(const char* key, std::optional<Part>& value) {
    part(key, value);
  }
  void finish() const { reader_.finish(); }

 private:
  template <typename Value>
  Value word(const char* key, Value (*from_text)(const std::string&)) {
    try {
      return from_text(reader_.text(key));
    } catch (const Error& e) {
      reader_.refuse(key, std::string("is wrong: ") + e.what());
    }
  }

  const json& value_;
  JsonReader reader_;
};

// What there is to keep, said once for both directions.

/// `Part` is `Of`, const or not.
template <typename Part, typename Of>
concept Either = std::same_as<std::remove_const_t<Part>, Of>;

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::CuttingCoefficients> auto& c) {
  v.field("friction", c.friction);
  v.field("depth_exponent", c.depth_exponent);
  v.field("speed_exponent", c.speed_exponent);
  v.field("friction_depth_exponent", c.friction_depth_exponent);
  v.field("friction_speed_exponent", c.friction_speed_exponent);
  v.field("edge_reference_mm", c.edge_reference_mm);
  v.field("edge_threshold_share", c.edge_threshold_share);
  v.field("tangential_ratio", c.tangential_ratio);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<PluginIdentity> auto& plugin) {
  v.field("name", plugin.name);
  v.field("version", plugin.version);
  v.field("sha256", plugin.sha256);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::FeedSettings> auto& feed) {
  v.field("kind", feed.kind);
  v.field("spindle_rad_s", feed.spindle_rad_s);
  v.field("specimen_factor", feed.specimen_factor);
  v.part("cutting", feed.cutting);
  v.rare_part("plugin", feed.plugin);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::SpindleSettings> auto& spindle) {
  v.field("stall_torque_n_mm", spindle.stall_torque_n_mm);
  v.field("droop_rad_s_per_n_mm", spindle.droop_rad_s_per_n_mm);
  v.field("inertia_kg_mm2", spindle.inertia_kg_mm2);
  v.field("start_s", spindle.start_s);
  v.field("coast_s", spindle.coast_s);
  v.field("catch_ratio", spindle.catch_ratio);
  v.field("mass_kg", spindle.mass_kg);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::VibrationRecordings> auto& recordings) {
  v.field("cortical", recordings.cortical);
  v.field("cancellous", recordings.cancellous);
  v.field("idle", recordings.idle);
  v.field("rate_hz", recordings.rate_hz);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::VibrationSettings> auto& vibration) {
  v.field("source", vibration.source);
  v.part("recordings", vibration.recordings);
  v.field("vibration_n_per_g", vibration.vibration_n_per_g);
  v.field("vibration_max_n", vibration.vibration_max_n);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::DeviceLimits> auto& limits) {
  v.field("force_max_n", limits.force_max_n);
  v.field("torque_max_n_mm", limits.torque_max_n_mm);
  v.field("force_slew_n", limits.force_slew_n);
  v.field("torque_slew_n_mm", limits.torque_slew_n_mm);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::VirtualMass> auto& mass) {
  v.field("mass_kg", mass.mass_kg);
  v.field("damping_n_s_mm", mass.damping_n_s_mm);
  v.field("gyration_radius_mm", mass.gyration_radius_mm);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<device::ScapulaMount> auto& mount) {
  v.field("stiffness_n_mm", mount.stiffness_n_mm);
  v.field("damping_n_s_mm", mount.damping_n_s_mm);
  v.field("angular_stiffness_n_mm_rad", mount.angular_stiffness_n_mm_rad);
  v.field("angular_damping_n_mm_s_rad", mount.angular_damping_n_mm_s_rad);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<force::HeatSettings> auto& heat) {
  v.field("conductivity_w_m_k", heat.conductivity_w_m_k);
  v.field("heat_capacity_mj_m3_k", heat.heat_capacity_mj_m3_k);
  v.field("share_into_bone", heat.share_into_bone);
  v.field("saline_film_w_m2_k", heat.saline_film_w_m2_k);
  v.field("least_area_mm2", heat.least_area_mm2);
  v.field("body_c", heat.body_c);
  v.field("saline_c", heat.saline_c);
}

template <typename Visitor>
void for_each_field(Visitor& v, Either<Settings> auto& settings) {
  v.field("physics", settings.physics);
  v.field("removal", settings.removal);
  v.field("decay_levels", settings.decay_levels);
  v.field("tool_spacing_mm", settings.tool_spacing_mm);
  v.field("force_scale", settings.force_scale);
  v.field("stiffness_n_mm", settings.stiffness_n_mm);
  v.field("angular_stiffness_n_mm_rad", settings.angular_stiffness_n_mm_rad);
  v.part("feed", settings.feed);
  v.part("spindle", settings.spindle);
  v.part("vibration", settings.vibration);
  v.part("limits", settings.limits);
  v.field("start_up_ramp_s", settings.start_up_ramp_s);
  v.field("energy_guarded", settings.energy_guarded);
  v.part("virtual_mass", settings.virtual_mass);
  v.part("mount", settings.mount);
  v.part("heat", settings.heat);
  v.field("random_seed", settings.random_seed);
}

/// Recordings come from outside, too: what would make a tick divide by nothing, or clamp the wrong way
/// around.
void check(const Settings& s, const std::string& place) {
  const auto above_zero = [&](const char* key, double value) {
    if (!(value > 0.0)) throw Error(ErrorKind::invalid_input, place + ": " + key + " must be above 0");
  };
  above_zero("feed.spindle_rad_s", s.feed.spindle_rad_s);
  above_zero("feed.cutting.edge_reference_mm", s.feed.cutting.edge_reference_mm);
  if (!(s.vibration.vibration_max_n >= 0.0))
    throw Error(ErrorKind::invalid_input, place + ": vibration.vibration_max_n must not be negative");
  above_zero("heat.conductivity_w_m_k", s.heat.conductivity_w_m_k);
  above_zero("heat.heat_capacity_mj_m3_k", s.heat.heat_capacity_mj_m3_k);
  above_zero("heat.least_area_mm2", s.heat.least_area_mm2);
  if (!s.spindle) return;
  above_zero("spindle.stall_torque_n_mm", s.spindle->stall_torque_n_mm);
  above_zero("spindle.droop_rad_s_per_n_mm", s.spindle->droop_rad_s_per_n_mm);
  above_zero("spindle.inertia_kg_mm2", s.spindle->inertia_kg_mm2);
  above_zero("spindle.start_s", s.spindle->start_s);
  above_zero("spindle.coast_s", s.spindle->coast_s);
  above_zero("spindle.catch_ratio", s.spindle->catch_ratio);
  above_zero("spindle.mass_kg", s.spindle->mass_kg);
}

/// A coupling turns as stiffly as its linear spring does on a lever of 32 mm, about the reamer's size, mm^2.
/// Engineering choice.
constexpr double angular_per_linear_mm2 = 1000.0;

}  // namespace

const char* to_text(RemovalLaw law) { return law == RemovalLaw::decay ? "decay" : "profile"; }

RemovalLaw removal_law_from_text(const std::string& text) {
  for (const RemovalLaw law : {RemovalLaw::profile, RemovalLaw::decay})
    if (text == to_text(law)) return law;
  throw Error(ErrorKind::invalid_input, "removal '" + text + "' must be profile or decay");
}

json to_json(const Settings& settings) {
  Writer writer;
  for_each_field(writer, settings);
  return writer.take();
}

Settings settings_from_json(const json& value, const std::string& place) {
  Settings settings;
  settings.physics = 1;
  Reader reader(value, place);
  for_each_field(reader, settings);
  reader.finish();
  check(settings, place);
  return settings;
}

void fit_to_device(const device::DeviceTraits& traits, double stiffness_n_mm, Settings& settings) {
  settings.stiffness_n_mm = stiffness_n_mm > 0.0 ? stiffness_n_mm : traits.stiffness_max_n_mm;
  settings.angular_stiffness_n_mm_rad =
      std::min(settings.stiffness_n_mm * angular_per_linear_mm2, traits.angular_stiffness_max_n_mm_rad);
  settings.limits = force::limits_for(traits.force_max_n, traits.torque_max_n_mm, settings.stiffness_n_mm,
                                      settings.angular_stiffness_n_mm_rad);
  settings.start_up_ramp_s = traits.start_up_ramp_s;
  settings.energy_guarded = traits.energy_guarded;
  settings.vibration.vibration_max_n = traits.vibration_max_n;
  settings.vibration.vibration_n_per_g = traits.handle_mass_kg * standard_gravity_m_s2;
  settings.virtual_mass.reset();
  if (traits.causality == device::Causality::admittance)
    settings.virtual_mass.emplace().mass_kg = traits.effective_mass_kg;
}

}  // namespace ream::sim
