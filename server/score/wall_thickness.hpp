#pragma once
#include <vector>

#include "score/component.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// How much of the component's outline is left out where its thinnest wall is looked for, mm (engineering
/// judgement): beside its rim the vault's wall is near, whatever is reamed.
inline constexpr double thin_rim_mm = 3.0;
/// The normal of a place is that of the plane that fits what was reamed within so far of it (engineering
/// judgement): single voxels of the surface lean by several degrees.
inline constexpr double normal_over_mm = 2.5;

/// Bone that is left behind what was reamed of the face, of every ray, mm: from the reamed face along its
/// normal to where the bone ends first. no_surface_mm off what was reamed, and where the bone reaches beyond
/// 45 mm. `left`: what remains, with the bone at rest.
std::vector<double> wall_thickness_mm(const NativeGlenoid& native, const AchievedFace& face,
                                      const CoverageView& left);

/// Least of it and its 5th percentile under the component, but for its rim.
void measure_wall_thickness(const NativeGlenoid& native, const AchievedFace& face, const CoverageView& left,
                            const Component& component, MetricResults& results);

}  // namespace ream::score
