#pragma once
#include "fe/element_model.hpp"
#include "fe/memory_budget.hpp"

namespace ream::fe {

/// After voxels were taken out of the model's mask, which was `before`: takes their gray codes out too.
void keep_elements(const VoxelMask& before, ElementModel& model, MemoryBudget& budget);

}  // namespace ream::fe
