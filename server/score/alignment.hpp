#pragma once
#include "score/component.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// How deep the reamer's apex is along the planned axis when it first touches the untouched face; empty when
/// it does not.
std::optional<double> first_contact_mm(const NativeGlenoid& native);

/// The achieved axis in the frame of the lattice; `world_from_plan`: the frame of `plan_line`.
CutLine in_lattice(const RayLattice& rays, const CutLine& plan_line, const Pose& world_from_plan);

/// What is asked of the session before it begins: angles of the plan, and how much reaming alone is to
/// correct.
void measure_plan(const Task& task, MetricResults& results);

/// Achieved axis against the plan: angles, entry, centre, depth. `line`: frame of the lattice.
void measure_alignment(const NativeGlenoid& native, const CutLine& line, double reaming_depth_mm,
                       MetricResults& results);

/// Angles of the plane through the rim of what was reamed; `normal`: world, lateral, empty without a rim.
void measure_rim(const Task& task, const std::optional<Vec3>& normal, MetricResults& results);

}  // namespace ream::score
