#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "case/case.hpp"
#include "case/landmarks.hpp"

namespace ream::case_ {

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

/// A plan whose axis has the wanted version and inclination (3D, science 2.1) and goes through the glenoid
/// centre; its entry is where that axis meets the surface (the centre itself where `surface` is empty).
/// Errors: invalid_input names landmarks that are missing or contradict each other, or an axis that misses
/// the bone; those of make_tool for an unknown reamer.
Plan propose_plan(const PlanTargets& targets, const Landmarks& landmarks, Side side,
                  const SurfaceAlong& surface);

}  // namespace ream::case_
