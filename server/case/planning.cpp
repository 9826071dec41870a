#include "case/planning.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "case/measures.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/json_reader.hpp"
#include "core/units.hpp"
#include "shell/reamer_library.hpp"

namespace ream::case_ {
using nlohmann::json;
namespace {

// Retroversion that remains: within 7 degrees of neutral is what good planning achieves, from 15 on the
// component loosens.
constexpr double retroversion_noted_deg = 7.0, retroversion_bad_deg = 15.0;
constexpr double angle_slack_deg = 1e-9;

std::string one_decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

void judge_angles(const Plan& plan, PlanAssessment& a) {
  if (a.correction_rad) {
    const double degrees = degrees_from_radians(*a.correction_rad);
    const bool too_much = degrees >= refused_correction_deg - angle_slack_deg;
    a.needs_override = too_much && !plan.override_correction;
    if (too_much)
      a.warnings.push_back("the plan corrects " + one_decimal(degrees) +
                           "\u00b0 by reaming alone; from 15\u00b0 pegged components perforate the vault "
                           "(Clavert 2007)");
    else if (degrees > warned_correction_deg + angle_slack_deg)
      a.warnings.push_back("the plan corrects " + one_decimal(degrees) +
                           "\u00b0 by reaming alone; eccentric reaming is used for 5\u00b0 to 10\u00b0");
  }
  if (!a.version_after_rad) return;
  const double retroversion = -degrees_from_radians(*a.version_after_rad);
  if (retroversion > retroversion_bad_deg + angle_slack_deg)
    a.warnings.push_back(one_decimal(retroversion) +
                         "\u00b0 retroversion would remain; over 15\u00b0 the component is likely to loosen "
                         "(Ho 2013)");
  else if (retroversion > retroversion_noted_deg + angle_slack_deg)
    a.warnings.push_back(
        one_decimal(retroversion) +
        "\u00b0 retroversion would remain; within 7\u00b0 of neutral is what planning achieves");
}

void judge_pilot_hole(const Plan& plan, const voxel::BoneModel& bone, PlanAssessment& a) {
  a.vault_depth_mm = bone_depth_along(bone, plan.entry_mm, plan.axis_direction);
  if (!a.vault_depth_mm) {
    a.warnings.push_back("the entry does not lie on the bone");
    return;
  }
  if (plan.depth_mm >= *a.vault_depth_mm)
    a.warnings.push_back("the depth of " + one_decimal(plan.depth_mm) +
                         " mm goes through the bone, of which " + one_decimal(*a.vault_depth_mm) +
                         " mm lie along the axis");
  if (plan.pilot_hole && plan.pilot_hole->depth_mm >= *a.vault_depth_mm)
    a.warnings.push_back("the pilot hole of " + one_decimal(plan.pilot_hole->depth_mm) +
                         " mm goes through the far cortex, which lies " + one_decimal(*a.vault_depth_mm) +
                         " mm below the entry");
}

void judge_reamer(const Plan& plan, const Landmarks& l, PlanAssessment& a) {
  shell::LibraryReamer reamer;
  try {
    reamer = shell::described_reamer(plan.reamer);
  } catch (const Error& e) {
    a.warnings.push_back(std::string("the reamer cannot be judged: ") + e.what());
    return;
  }
  const auto words = [&](const char* relation, double size_mm, const char* what, const char* effect) {
    return "the reamer's diameter of " + one_decimal(reamer.diameter_mm) + " mm is " + relation +
           " than the glenoid is " + what + " (" + one_decimal(size_mm) + " mm): " + effect;
  };
  if (l.superior_rim_mm && l.inferior_rim_mm) {
    const double height = (*l.superior_rim_mm - *l.inferior_rim_mm).norm();
    if (reamer.diameter_mm > height)
      a.warnings.push_back(words("larger", height, "high", "it reaches beyond the rim all around"));
  }
  if (l.anterior_rim_mm && l.posterior_rim_mm) {
    const double width = (*l.anterior_rim_mm - *l.posterior_rim_mm).norm();
    if (reamer.diameter_mm < width)
      a.warnings.push_back(words("smaller", width, "wide", "it leaves a ledge in front and behind"));
  }
  if (reamer.cannulated && plan.guide != GuideKind::pin)
    a.warnings.push_back("the reamer is cannulated; guide it by a pin");
}

}  // namespace

std::optional<Vec3> native_face(const Landmarks& l, Side side, const GlenoidFrame* glenoid) {
  const bool rim = l.superior_rim_mm && l.inferior_rim_mm && l.glenoid_centre_mm &&
                   (l.biconcavity_mm.size() == 3 || (l.anterior_rim_mm && l.posterior_rim_mm));
  if (rim) return glenoid_frame(l, side).lateral;
  if (glenoid) return glenoid->lateral;
  return std::nullopt;
}

PlanAssessment assess_plan(const Plan& plan, const Landmarks& landmarks, Side side,
                           const voxel::BoneModel* bone, const GlenoidFrame* glenoid) {
  PlanAssessment a;
  const Measures measures = measure(landmarks, side);
  const Vec3 planned_face = -plan.axis_direction;
  if (const auto native = native_face(landmarks, side, glenoid))
    a.correction_rad = std::atan2(native->cross(planned_face).norm(), native->dot(planned_face));
  a.version_before_rad = measures.version_3d_rad;
  a.inclination_before_rad = measures.inclination_3d_rad;
  if (landmarks.glenoid_centre_mm && landmarks.trigonum_mm && landmarks.inferior_angle_mm) {
    const FaceAngles after = face_angles(planned_face, *landmarks.glenoid_centre_mm, *landmarks.trigonum_mm,
                                         *landmarks.inferior_angle_mm);
    a.version_after_rad = after.version_rad;
    a.inclination_after_rad = after.inclination_rad;
  }
  judge_angles(plan, a);
  if (bone) judge_pilot_hole(plan, *bone, a);
  judge_reamer(plan, landmarks, a);
  return a;
}

std::string why_refused(const PlanAssessment& a) {
  return "the plan corrects " + one_decimal(degrees_from_radians(a.correction_rad.value_or(0.0))) +
         "\u00b0 by reaming alone, which is refused from 15\u00b0 (pegged components perforate the vault, "
         "Clavert 2007); aim nearer to the native face" +
         (a.version_before_rad ? " (" + version_in_words(*a.version_before_rad) + ")" : "") +
         ", or override with a reason";
}

json to_json(const PlanAssessment& a) {
  const auto words = [](const std::optional<double>& rad, std::string (*in_words)(double)) {
    return rad ? json(in_words(*rad)) : json(nullptr);
  };
  return {{"correction_deg", degrees_or_null(a.correction_rad)},
          {"version_before_deg", degrees_or_null(a.version_before_rad)},
          {"inclination_before_deg", degrees_or_null(a.inclination_before_rad)},
          {"version_after_deg", degrees_or_null(a.version_after_rad)},
          {"inclination_after_deg", degrees_or_null(a.inclination_after_rad)},
          {"vault_depth_mm", or_null(a.vault_depth_mm)},
          {"warnings", a.warnings},
          {"needs_override", a.needs_override},
          {"words",
           {{"version_before", words(a.version_before_rad, version_in_words)},
            {"version_after", words(a.version_after_rad, version_in_words)},
            {"inclination_before", words(a.inclination_before_rad, inclination_in_words)},
            {"inclination_after", words(a.inclination_after_rad, inclination_in_words)}}}};
}

namespace {

constexpr double max_proposed_target_deg = 40.0;
constexpr double max_proposed_length_mm = 100.0;

/// Inclination beyond this is worth correcting; within it, a proposal leaves it as it is.
constexpr double kept_inclination_deg = 10.0;

/// A reamer of this radius is in common use.
constexpr double default_radius_mm = 40.0;

/// Thickness of the wire on which cannulated reamers run, and how far it is drilled in.
constexpr PilotHole pin_hole{2.5, 20.0};

/// How far outside the bone the search for the entry begins.
constexpr double search_from_mm = 60.0;

std::optional<double> angle(JsonReader& reader, const char* key) {
  if (!reader.has(key)) return std::nullopt;
  return radians_from_degrees(reader.number(key, -max_proposed_target_deg, max_proposed_target_deg));
}

std::optional<double> length(JsonReader& reader, const char* key) {
  if (!reader.has(key)) return std::nullopt;
  return reader.number(key, 0.0, max_proposed_length_mm);
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

PlanTargets plan_targets_from_json(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  PlanTargets targets;
  targets.version_rad = angle(reader, "version_deg");
  targets.inclination_rad = angle(reader, "inclination_deg");
  targets.depth_mm = length(reader, "depth_mm");
  targets.implant_radius_mm = length(reader, "implant_radius_mm");
  targets.implant_size = reader.text_or("implant_size", "");
  targets.reamer = reader.text_or("reamer", "");
  if (reader.has("pilot_diameter_mm") || reader.has("pilot_depth_mm"))
    targets.pilot_hole = PilotHole{reader.number("pilot_diameter_mm", 0.1, max_proposed_length_mm),
                                   reader.number("pilot_depth_mm", 0.1, max_proposed_length_mm)};
  if (reader.has("guide")) targets.guide = guide_from_json(reader);
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
                    : shell::reamer_for_implant(targets.implant_radius_mm.value_or(default_radius_mm)).name;
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
