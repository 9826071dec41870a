#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "score/metric_results.hpp"
#include "score/native_glenoid.hpp"

namespace ream::score {

/// Metrics that are known of a plan before anything is done.
inline constexpr std::string_view outcome_metrics[] = {
    "seating_percent",  "plate_preserved_percent", "footprint_area_mm2",          "depth_mean_mm",
    "medialization_mm", "joint_line_mm",           "vault_distance_component_mm", "parts_through_vault"};

/// What a plan reaches if it is carried out exactly: the reamer (Task::reamer) has gone down the planned axis
/// to the planned depth, and the plan's component is seated there. By formulas along the rays of the
/// NativeGlenoid. Has outcome_metrics, without those that need a component where no bone is left to seat it
/// on, and other distances of the vault; nothing where the plan's reamer does not touch the face.
MetricResults plan_outcome(const NativeGlenoid& native);

/// Each of outcome_metrics: its number, or null.
nlohmann::json outcome_json(const MetricResults& outcome);

}  // namespace ream::score
