#pragma once
#include <optional>

#include "case/measures.hpp"
#include "score/component.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// Why what rests on the scapula's frame is missing.
inline constexpr const char* no_scapular_frame =
    "the case lacks one of the landmarks trigonum, inferior angle and glenoid centre";
/// By the case's landmarks; empty when one is missing, or they lie on one line.
std::optional<case_::ScapularFrame> scapular_frame_of(const Task& task);

/// How deep the reamer's apex is along the planned axis when it first touches the untouched face; empty when
/// it does not.
std::optional<double> first_contact_mm(const NativeGlenoid& native);

/// The achieved axis in the frame of the lattice; `world_from_plan`: the frame of `plan_line`.
CutLine in_lattice(const RayLattice& rays, const CutLine& plan_line, const Pose& world_from_plan);

/// What is asked of the session before it begins: angles of the plan, and how much reaming alone is to
/// correct.
void measure_plan(const Task& task, MetricResults& results);

/// Achieved axis against the plan: angles, entry, centre. `line`: frame of the lattice.
void measure_alignment(const NativeGlenoid& native, const CutLine& line, MetricResults& results);

/// Angles of the plane through the rim of what was reamed; `normal`: world, lateral, empty without a rim.
void measure_rim(const Task& task, const std::optional<Vec3>& normal, MetricResults& results);

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
