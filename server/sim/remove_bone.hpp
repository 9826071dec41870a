#pragma once
#include "sim/state.hpp"

namespace ream::sim {

/// Removes what the tool cuts at `grid_from_tool` by the law of the settings, tells the followers, and folds
/// the changes into report and session hash. False when the device failed and nothing could take over.
bool remove_bone(State& state, const QuantisedPose& grid_from_tool, TickReport& report) noexcept;

}  // namespace ream::sim
