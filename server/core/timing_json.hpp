#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/timing_histogram.hpp"

namespace ream {

/// Names of the figures: timing.json has "mean", "p50", ..., REST has "mean_us", "p50_us", ...
enum class TimingKeys { bare, with_unit };

/// Mean, percentiles and maximum; not the count.
nlohmann::json timing_json(const TimingSummary& times, TimingKeys keys);

/// From bare keys; what is missing is 0. Throws json::exception for other types.
TimingSummary timing_from(const nlohmann::json& times);

}  // namespace ream
