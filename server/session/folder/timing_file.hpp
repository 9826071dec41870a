#pragma once
#include <nlohmann/json_fwd.hpp>

#include "sim/loop_health.hpp"

namespace ream::session {

/// timing.json: how the haptic loop did, times in us.
nlohmann::json timing_file_json(const sim::LoopHealth& health);

/// What it says; sessions of earlier builds say less. Throws json::exception for values of other types.
sim::LoopHealth loop_health_from(const nlohmann::json& timing);

}  // namespace ream::session
