#include "score/surface_findings.hpp"

#include "score/alignment_findings.hpp"

namespace ream::score {
namespace {

constexpr const char* bone_keys[] = {"depth_max_mm",           "depth_mean_mm",           "medialization_mm",
                                     "footprint_area_mm2",     "seating_percent",         "congruity_mm",
                                     "fitted_radius_mm",       "plate_preserved_percent", "vault_distance_mm",
                                     "vault_distance_keel_mm", "vault_distance_tool_mm",  "vault_breach_mm",
                                     "version_rim_deg",        "inclination_rim_deg"};

bool has_face(const NativeGlenoid& native) {
  for (const uint8_t face : native.face())
    if (face) return true;
  return false;
}

}  // namespace

CutLine in_lattice(const RayLattice& rays, const CutLine& plan_line, const Pose& world_from_plan) {
  CutLine line;
  line.apex_mm = rays.in_lattice(world_from_plan.point(plan_line.apex_mm));
  line.direction = rays.lattice_direction(world_from_plan.direction(plan_line.direction));
  // The plan's z and the lattice's depth differ only where there is no plan.
  line.deepest_mm = rays.in_lattice(world_from_plan.point(plan_line.deepest_apex_mm())).z();
  return line;
}

void leave_bone(const std::string& reason, Findings& findings) {
  for (const char* key : bone_keys) findings.leave(key, reason);
}

Findings surface_findings(const NativeGlenoid& native, const CoverageView& left,
                          const std::optional<CutLine>& plan_line, const Pose& world_from_plan,
                          double reaming_depth_mm) {
  Findings findings;
  say_plan(native.task(), findings);
  if (!has_face(native)) {
    const char* no_face = "the planned axis meets no face of bone";
    leave_bone(no_face, findings);
    leave_alignment(no_face, findings);
    findings.leave("plate_thickness_mm", no_face);
    return findings;
  }
  findings.say("plate_thickness_mm", native.plate().median_mm);
  if (!plan_line) {
    const char* untouched = "no bone was removed";
    leave_bone(untouched, findings);
    leave_alignment(untouched, findings);
    return findings;
  }
  const CutLine line = in_lattice(native.rays(), *plan_line, world_from_plan);
  const AchievedFace face = achieved_face(native, left);
  say_alignment(native, line, reaming_depth_mm, findings);
  say_depths(native, face, findings);
  say_congruity(native, face, findings);
  say_rim(native.task(), rim_normal(native, face), findings);
  const Component component(native, face, line);
  if (component.seated())
    findings.say("seating_percent", 100.0 * component.supported_share());
  else
    findings.leave("seating_percent", "there is no bone left to seat a component on");
  say_plate(native, face, component, findings);
  say_vault(native, component, line, findings);
  return findings;
}

}  // namespace ream::score
