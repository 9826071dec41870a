#pragma once
#include "score/component.hpp"
#include "score/metric_results.hpp"
#include "score/planned_face.hpp"

namespace ream::score {

/// Everything that bone and achieved axis tell; never throws. `planned`: planned_face(native). `plan_line`:
/// CutAxis::line(), empty when nothing was cut; `world_from_plan`: its frame. `left`: what remains, with the
/// bone at rest.
MetricResults bone_results(const NativeGlenoid& native, const PlannedFace& planned, const CoverageView& left,
                           const std::optional<CutLine>& plan_line, const Pose& world_from_plan);

/// Sets how deep the reaming is, see DepthGauge, and how far that is from the plan.
void set_depth(const Task& task, double depth_mm, MetricResults& results);

/// The same of a bone that cannot be measured: all of it is missing, for this reason.
MetricResults missing_bone_results(const std::string& reason);

}  // namespace ream::score
