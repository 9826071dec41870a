#pragma once
#include <optional>

#include "score/component.hpp"

namespace ream::score {

/// Where a body of revolution stands: world frame, z of the body along `axis` into the bone, its apex at
/// `apex_mm`.
struct Placement {
  Vec3 apex_mm = Vec3::Zero(), axis = Vec3::UnitZ();

  Pose world_from_body() const { return {rotation_with_z_along(axis), apex_mm}; }
};

/// Where reamer and implant come to stand on a bone; empty where that is not known.
struct Placements {
  std::optional<Placement> planned;   ///< the reamer, when it has gone as deep as planned
  std::optional<Placement> achieved;  ///< the reamer at its deepest, along the achieved axis
  std::optional<Placement> implant;   ///< the seated component, see Component
};

/// `plan_line` and `world_from_plan` as for bone_results; `left`: what remains, with the bone at rest.
Placements placements_of(const NativeGlenoid& native, const CoverageView& left,
                         const std::optional<CutLine>& plan_line, const Pose& world_from_plan);

/// The planned implant's back (a sphere of its radius as wide as the reamer; without one the reamer's shape),
/// `thickness_mm` behind its rim.
SweptFront implant_back(const Task& task, double thickness_mm);

}  // namespace ream::score
