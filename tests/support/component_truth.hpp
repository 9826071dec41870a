#pragma once
#include <string_view>
#include <vector>

#include "support/reaming_truth.hpp"

namespace ream::test {

/// How far the middle of an articular surface lies lateral of where the plan meets the face: along the plan,
/// and along the scapula's lateral axis. Every component is 4 mm thick.
double joint_line_truth_mm(const PlannedReaming& planned, const SeatedTruth& seated);
double lateralization_truth_mm(const PlannedReaming& planned, const SeatedTruth& seated);

/// Least distance of each peg or keel of a component from the vault's wall and far end, negative where it
/// reaches beyond them; by the formulas of the vault alone. `component`: its name; "" for the one that stands
/// for an unknown one.
std::vector<double> vault_truth_mm(const AnalyticGlenoid& glenoid, const SeatedTruth& seated,
                                   std::string_view component);

/// Bone behind the reamed face, along the normal of the plane that fits it within 2.5 mm, at the places
/// within a radius of the component's axis: the least, and what a twentieth of the places fall below.
struct WallTruth {
  double least_mm = 0.0, thin_mm = 0.0;
};
WallTruth wall_truth(const PlannedReaming& planned, const SeatedTruth& seated, double within_mm,
                     double spacing_mm, const std::vector<ReamedPlace>& places);

}  // namespace ream::test
