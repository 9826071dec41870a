#pragma once
#include <functional>

#include "bench/baselines/flat_kernel.hpp"

namespace ream::bench {

/// Share (0 to 1) of all points of the shell that are inside the bone.
double share_inside(Voxmap& voxmap, const MortonShell& shell, const QuantisedPose& grid_from_tool);

/// The smallest depth, mm, between `low_mm` and `high_mm` at which `share` of all points are inside, where
/// `grid_from_tool(depth_mm)` moves the tool into the bone. Throws Error invalid_input when the share is not
/// reached.
double depth_of_share(Voxmap& voxmap, const MortonShell& shell, double share, double low_mm, double high_mm,
                      const std::function<QuantisedPose(double depth_mm)>& grid_from_tool);

}  // namespace ream::bench
