#include "bench/depth_of_share.hpp"

#include "core/error.hpp"

namespace ream::bench {

double share_inside(Voxmap& voxmap, const MortonShell& shell, const QuantisedPose& grid_from_tool) {
  return flat_contact_cpu(voxmap, shell, grid_from_tool).inside / static_cast<double>(shell.codes.size());
}

double depth_of_share(Voxmap& voxmap, const MortonShell& shell, double share, double low_mm, double high_mm,
                      const std::function<QuantisedPose(double depth_mm)>& grid_from_tool) {
  constexpr double first_step_mm = 0.25;
  constexpr int bisections = 16;
  const auto reached = [&](double depth_mm) {
    return share_inside(voxmap, shell, grid_from_tool(depth_mm)) >= share;
  };
  // The share need not grow all the way, so the first depth that reaches it is walked to.
  double above = low_mm, below = low_mm;
  while (!reached(below)) {
    above = below;
    below += first_step_mm;
    if (below > high_mm)
      throw Error(ErrorKind::invalid_input, "bench: no depth puts " + std::to_string(100.0 * share) +
                                                " % of the tool's points into this bone");
  }
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (above + below);
    (reached(middle) ? below : above) = middle;
  }
  return below;
}

}  // namespace ream::bench
