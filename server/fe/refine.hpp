#pragma once
#include "core/progress.hpp"
#include "fe/element_model.hpp"
#include "fe/memory_budget.hpp"

namespace ream::fe {

/// Splits every voxel into factor^3 (thesis section 2.2): the volume stays what it was. Gray values are
/// interpolated linearly between voxel centres (voxel::upsample_tap); where a neighbour is no element, the
/// voxel's own value stands for it, so that no value outside the bone matters. Exact in whole numbers,
/// rounded once, halves up. Takes from the budget; on two threads. Throws Error invalid_input for a factor
/// outside 1 to voxel::max_upsample_factor.
ElementModel refined(ElementModel model, int factor, MemoryBudget& budget,
                     const Progress& progress = no_progress);

}  // namespace ream::fe
