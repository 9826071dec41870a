#include "case/plan_proposal.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "case/measures.hpp"
#include "case/plan.hpp"
#include "case/scapular_frame.hpp"
#include "core/error.hpp"
#include "core/json_reader.hpp"
#include "core/units.hpp"
#include "shell/reamer_library.hpp"

namespace ream::case_ {
namespace {

constexpr double max_target_deg = 40.0;
constexpr double max_length_mm = 100.0;

/// Inclination beyond this is worth correcting; within it, a proposal leaves it as it is.
constexpr double kept_inclination_deg = 10.0;

/// A reamer of this radius is in common use (science 2.2, 2.4).
constexpr double usual_radius_mm = 40.0;

/// Thickness of the wire on which cannulated reamers run, and how far it is drilled in.
constexpr PilotHole pin_hole{2.5, 20.0};

/// How far outside the bone the search for the entry begins.
constexpr double search_from_mm = 60.0;

std::optional<double> angle(JsonReader& reader, const char* key) {
  if (!reader.has(key)) return std::nullopt;
  return radians_from_degrees(reader.number(key, -max_target_deg, max_target_deg));
}

std::optional<double> length(JsonReader& reader, const char* key) {
  if (!reader.has(key)) return std::nullopt;
  return reader.number(key, 0.0, max_length_mm);
}

ScapularFrame frame_for_plan(const Landmarks& l) {
  if (!l.glenoid_centre_mm || !l.trigonum_mm || !l.inferior_angle_mm)
    throw Error(ErrorKind::invalid_input,
                "a plan by version and inclination needs the landmarks glenoid_centre_mm, trigonum_mm and "
                "inferior_angle_mm; place them, or give the axis itself");
  return scapular_frame(*l.glenoid_centre_mm, *l.trigonum_mm, *l.inferior_angle_mm);
}

double proposed_inclination(const Measures& measures) {
  const double kept = radians_from_degrees(kept_inclination_deg);
  return std::clamp(measures.inclination_3d_rad.value_or(0.0), -kept, kept);
}

/// Hole and guide that go with the reamer, where the targets do not say otherwise.
void set_guide(Plan& plan, const PlanTargets& targets, const shell::LibraryReamer& reamer) {
  plan.guide = reamer.cannulated ? GuideKind::pin : reamer.nipple ? GuideKind::nipple : GuideKind::none;
  PilotHole hole;
  if (reamer.nipple) {
    hole.diameter_mm = std::max(hole.diameter_mm, 2.0 * reamer.nipple->radius_mm + 0.2);
    hole.depth_mm = std::max(hole.depth_mm, reamer.nipple->height_mm + plan.depth_mm + 2.0);
  }
  plan.pilot_hole = reamer.cannulated ? pin_hole : hole;
  if (targets.pilot_hole) plan.pilot_hole = targets.pilot_hole;
  if (targets.guide) plan.guide = *targets.guide;
}

}  // namespace

PlanTargets plan_targets_from_json(const nlohmann::json& value, const std::string& place) {
  JsonReader reader(value, place);
  PlanTargets targets;
  targets.version_rad = angle(reader, "version_deg");
  targets.inclination_rad = angle(reader, "inclination_deg");
  targets.depth_mm = length(reader, "depth_mm");
  targets.implant_radius_mm = length(reader, "implant_radius_mm");
  targets.implant_size = reader.text_or("implant_size", "");
  targets.reamer = reader.text_or("reamer", "");
  if (reader.has("pilot_diameter_mm") || reader.has("pilot_depth_mm"))
    targets.pilot_hole = PilotHole{reader.number("pilot_diameter_mm", 0.1, max_length_mm),
                                   reader.number("pilot_depth_mm", 0.1, max_length_mm)};
  if (reader.has("guide")) {
    const std::string guide = reader.text("guide");
    if (guide != "none" && guide != "nipple" && guide != "pin")
      reader.refuse("guide", "must be none, nipple or pin");
    targets.guide = guide_from_text(guide);
  }
  reader.finish();
  return targets;
}

Plan propose_plan(const PlanTargets& targets, const Landmarks& landmarks, Side side,
                  const SurfaceAlong& surface) {
  const Measures measures = measure(landmarks, side);
  const ScapularFrame frame = frame_for_plan(landmarks);
  Plan plan;
  plan.target_version_rad = targets.version_rad.value_or(0.0);
  plan.target_inclination_rad =
      targets.inclination_rad ? *targets.inclination_rad : proposed_inclination(measures);
  plan.axis_direction = -frame.face_normal({*plan.target_version_rad, *plan.target_inclination_rad});
  plan.depth_mm = targets.depth_mm.value_or(plan.depth_mm);
  plan.implant_radius_mm = targets.implant_radius_mm;
  plan.implant_size = targets.implant_size;
  plan.reamer = !targets.reamer.empty()
                    ? targets.reamer
                    : shell::reamer_for_implant(targets.implant_radius_mm.value_or(usual_radius_mm)).name;
  set_guide(plan, targets, shell::described_reamer(plan.reamer));
  plan.entry_mm = *landmarks.glenoid_centre_mm;
  if (surface) {
    const auto entry = surface(plan.entry_mm - search_from_mm * plan.axis_direction, plan.axis_direction);
    if (!entry)
      throw Error(
          ErrorKind::invalid_input,
          "the planned axis misses the bone: the glenoid centre and the other landmarks do not lie on "
          "it; place them anew");
    plan.entry_mm = *entry;
  }
  validate(plan, "the proposed plan");
  return plan;
}

}  // namespace ream::case_
