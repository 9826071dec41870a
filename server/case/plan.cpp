#include "case/plan.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json_reader.hpp"
#include "core/units.hpp"
#include "geometry/pose_json.hpp"

namespace ream::case_ {
namespace {

constexpr double max_length_mm = 100.0;  // no glenoid is reamed or drilled deeper than this
constexpr double max_coordinate_mm = 1e5;
constexpr double max_target_deg = 60.0;
constexpr double kept_per_degree = 1e9;  // degrees are written to 1e-9, so that reading them changes nothing

void check_length(const std::string& place, const char* key, double value, bool may_be_zero) {
  if (value > 0.0 && value <= max_length_mm) return;
  if (may_be_zero && value == 0.0) return;
  throw Error(ErrorKind::invalid_input, place + ": " + key + " is " + std::to_string(value) + ", must be " +
                                            (may_be_zero ? "from 0 to " : "above 0 and at most ") +
                                            std::to_string(static_cast<int>(max_length_mm)) + " mm");
}

void check_target(const std::string& place, const char* key, const std::optional<double>& rad) {
  if (!rad || std::abs(degrees_from_radians(*rad)) <= max_target_deg + 1.0 / kept_per_degree) return;
  throw Error(ErrorKind::invalid_input, place + ": " + key + " must be between -" +
                                            std::to_string(static_cast<int>(max_target_deg)) + " and " +
                                            std::to_string(static_cast<int>(max_target_deg)) + " degrees");
}

double written_degrees(double rad) {
  return std::floor(degrees_from_radians(rad) * kept_per_degree + 0.5) / kept_per_degree;
}

void read_targets(JsonReader& reader, Plan& plan) {
  if (reader.has("implant_radius_mm")) plan.implant_radius_mm = reader.number("implant_radius_mm");
  plan.implant_size = reader.text_or("implant_size", "");
  if (reader.has("version_deg")) plan.target_version_rad = radians_from_degrees(reader.number("version_deg"));
  if (reader.has("inclination_deg"))
    plan.target_inclination_rad = radians_from_degrees(reader.number("inclination_deg"));
  plan.override_correction = reader.boolean_or("override", false);
  plan.override_reason = reader.text_or("override_reason", "");
}

/// Programs that know of none of these read a plan that has none of them.
void write_targets(const Plan& plan, nlohmann::json& value) {
  if (plan.implant_radius_mm) value["implant_radius_mm"] = *plan.implant_radius_mm;
  if (!plan.implant_size.empty()) value["implant_size"] = plan.implant_size;
  if (plan.target_version_rad) value["version_deg"] = written_degrees(*plan.target_version_rad);
  if (plan.target_inclination_rad) value["inclination_deg"] = written_degrees(*plan.target_inclination_rad);
  if (plan.override_correction) value["override"] = true;
  if (!plan.override_reason.empty()) value["override_reason"] = plan.override_reason;
}

}  // namespace

void validate(const Plan& plan, const std::string& place) {
  if (!(plan.entry_mm.cwiseAbs().maxCoeff() <= max_coordinate_mm))
    throw Error(ErrorKind::invalid_input, place + ": entry_mm must be three finite coordinates in mm");
  if (!(std::abs(plan.axis_direction.norm() - 1.0) < 1e-6))
    throw Error(ErrorKind::invalid_input, place + ": axis_direction must not be zero");
  check_length(place, "depth_mm", plan.depth_mm, true);
  if (plan.reamer.empty()) throw Error(ErrorKind::invalid_input, place + ": reamer must name a tool");
  if (plan.guide == GuideKind::nipple && !plan.pilot_hole)
    throw Error(ErrorKind::invalid_input,
                place + ": guide is nipple, which needs a pilot hole; plan one, or guide none or pin");
  if (plan.implant_radius_mm) check_length(place, "implant_radius_mm", *plan.implant_radius_mm, false);
  check_target(place, "version_deg", plan.target_version_rad);
  check_target(place, "inclination_deg", plan.target_inclination_rad);
  if (!plan.override_reason.empty() && !plan.override_correction)
    throw Error(ErrorKind::invalid_input, place + ": override_reason is given without override");
  if (!plan.pilot_hole) return;
  check_length(place, "pilot_diameter_mm", plan.pilot_hole->diameter_mm, false);
  check_length(place, "pilot_depth_mm", plan.pilot_hole->depth_mm, false);
}

Plan plan_from_json(const nlohmann::json& value, const std::string& place) {
  JsonReader reader(value, place);
  Plan plan;
  plan.entry_mm = read_vec3(reader, "entry_mm");
  plan.axis_direction = read_vec3(reader, "axis_direction");
  const double length = plan.axis_direction.norm();
  if (!(length > 1e-9)) reader.refuse("axis_direction", "must not be zero");
  // An already unit direction keeps its bits, so that reading and writing a plan changes nothing.
  if (std::abs(length - 1.0) > 1e-12) plan.axis_direction /= length;
  plan.depth_mm = reader.number("depth_mm");
  plan.reamer = reader.text("reamer");
  plan.pilot_hole.reset();
  if (reader.has("pilot_diameter_mm") || reader.has("pilot_depth_mm"))
    plan.pilot_hole = PilotHole{reader.number("pilot_diameter_mm"), reader.number("pilot_depth_mm")};
  if (reader.has("guide")) plan.guide = guide_from_json(reader);
  read_targets(reader, plan);
  reader.finish();
  validate(plan, place);
  return plan;
}

nlohmann::json to_json(const Plan& plan) {
  nlohmann::json value = {{"entry_mm", json_of(plan.entry_mm)},
                          {"axis_direction", json_of(plan.axis_direction)},
                          {"depth_mm", plan.depth_mm},
                          {"reamer", plan.reamer}};
  // Programs that know of no guides read a plan that needs none.
  if (plan.guide != GuideKind::none) value["guide"] = to_text(plan.guide);
  if (plan.pilot_hole) {
    value["pilot_diameter_mm"] = plan.pilot_hole->diameter_mm;
    value["pilot_depth_mm"] = plan.pilot_hole->depth_mm;
  }
  write_targets(plan, value);
  return value;
}

void save_plan(const Plan& plan, const std::filesystem::path& case_folder) {
  validate(plan, "plan of " + case_folder.string());
  if (!std::filesystem::is_regular_file(case_folder / "case.json") &&
      !std::filesystem::is_regular_file(case_folder / "ct" / "ct.json"))
    throw Error(ErrorKind::not_found, case_folder.string() + " is not a case: it has no case.json");
  write_json_file(case_folder / "plan.json", to_json(plan));
}

}  // namespace ream::case_
