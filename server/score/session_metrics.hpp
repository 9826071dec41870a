#pragma once
#include <nlohmann/json_fwd.hpp>

#include "score/metrics.hpp"

namespace ream::score {

/// metrics.json (proto/metrics.schema.json): what the ticks say, what the bone says, and for every metric
/// that is null why. `grid_hash` as for metrics_json.
nlohmann::json session_metrics_json(const MetricsAccumulator& ticks, const Findings& of_bone,
                                    double force_scale, const uint64_t* grid_hash);

/// What the bone says when it cannot be measured: everything unsaid, for this reason.
Findings bone_unsaid(const std::string& reason);

}  // namespace ream::score
