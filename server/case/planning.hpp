#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/landmarks.hpp"

namespace ream::case_ {

/// Beyond this, reaming alone corrects badly; from the second on, components perforate the vault (Clavert
/// 2007: at 15 degrees and more 5 of 5 pegged components).
inline constexpr double warned_correction_deg = 10.0, refused_correction_deg = 15.0;

/// What a plan would do to a glenoid. Angles rad; empty where the landmarks for them are missing.
struct PlanAssessment {
  std::optional<double> correction_rad;  ///< between the native face normal and the planned axis
  std::optional<double> version_before_rad, inclination_before_rad;  ///< 3D
  std::optional<double> version_after_rad, inclination_after_rad;    ///< of a face across the axis
  std::optional<double> vault_depth_mm;  ///< along the axis from the entry to the far cortex; needs the bone
  std::vector<std::string> warnings;     ///< one line each
  bool needs_override = false;           ///< 15 degrees or more, and the plan does not override
};

/// `bone` (before any hole is cut) and `glenoid` may be null; without rim landmarks the glenoid frame's face
/// stands for the native one. Never refuses a plan that validate() takes: callers that change a plan ask
/// needs_override. Error invalid_input for landmarks that contradict each other.
PlanAssessment assess_plan(const Plan& plan, const Landmarks& landmarks, Side side,
                           const voxel::BoneModel* bone = nullptr, const GlenoidFrame* glenoid = nullptr);

/// Normal of the native face, lateral: by the rim landmarks, else that of the glenoid frame (which may be
/// null); empty without both. Error invalid_input for landmarks that contradict each other.
std::optional<Vec3> native_face(const Landmarks& landmarks, Side side, const GlenoidFrame* glenoid);

/// One line for people that says how much is asked and what to do; for needs_override.
std::string why_refused(const PlanAssessment& assessment);

/// Angles in degrees, empty ones null.
nlohmann::json to_json(const PlanAssessment& assessment);

/// What a plan is to reach. Every key is optional; what is not given is proposed.
struct PlanTargets {
  std::optional<double> version_rad;      ///< proposed: neutral
  std::optional<double> inclination_rad;  ///< proposed: as it is, but at most 10 degrees either way
  std::optional<double> depth_mm;
  std::optional<double> implant_radius_mm;  ///< of the component's back; picks the reamer
  std::string implant_size;
  std::string reamer;  ///< name in the library, make_tool words or a mesh; "": by the implant's radius
  std::optional<PilotHole> pilot_hole;
  std::optional<GuideKind> guide;
};

/// Keys version_deg, inclination_deg, depth_mm, implant_radius_mm, implant_size, reamer, pilot_diameter_mm,
/// pilot_depth_mm (both or neither), guide. Error invalid_input names place and key.
PlanTargets plan_targets_from_json(const nlohmann::json& value, const std::string& place);

/// First bone met when moving along a direction through a point, world mm; empty when there is none.
using SurfaceAlong = std::function<std::optional<Vec3>(const Vec3& point_mm, const Vec3& direction)>;

/// A plan whose axis has the requested version and inclination (3D) and goes through the glenoid
/// centre; its entry is where that axis meets the surface (the centre itself where `surface` is empty).
/// Errors: invalid_input names landmarks that are missing or contradict each other, or an axis that misses
/// the bone; those of make_tool for an unknown reamer.
Plan propose_plan(const PlanTargets& targets, const Landmarks& landmarks, Side side,
                  const SurfaceAlong& surface);

}  // namespace ream::case_
