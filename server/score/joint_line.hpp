#pragma once
#include "score/component.hpp"
#include "score/metric_results.hpp"
#include "score/planned_face.hpp"

namespace ream::score {

/// How far the middle of a component's articular surface lies lateral of the native joint line, mm, medial
/// negative: along the planned axis from where that meets the untouched face. The articular surface is as far
/// from the middle of the back as the component is thick. Empty where the component is not seated, or the
/// planned axis meets no bone.
std::optional<double> joint_line_mm(const NativeGlenoid& native, const Component& component);

/// Joint line achieved and against the plan, and the same along the scapula's lateral axis.
void measure_joint_line(const NativeGlenoid& native, const PlannedFace& planned, const Component& component,
                        MetricResults& results);

}  // namespace ream::score
