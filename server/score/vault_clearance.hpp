#pragma once
#include "score/component.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// How far the virtual pegs and keel, those of the plan's component (component_of), and the tool at its
/// deepest stay from the outer cortex. `line`: frame of the lattice.
void measure_vault_clearance(const NativeGlenoid& native, const Component& component, const CutLine& line,
                             MetricResults& results);

}  // namespace ream::score
