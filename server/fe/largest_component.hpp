#pragma once
#include "core/progress.hpp"
#include "fe/element_model.hpp"
#include "fe/memory_budget.hpp"

namespace ream::fe {

/// What hung together by faces before all but the largest part was taken away.
struct ComponentCount {
  uint64_t components = 0;      ///< one more than islands
  uint64_t removed_voxels = 0;  ///< of the islands
};

/// Keeps the largest 6-connected component of the model (of equal ones the first) and its gray codes. On two
/// threads; memory is four bytes a run of voxels, taken from the budget. The mask must not be empty.
ComponentCount keep_largest_component(ElementModel& model, MemoryBudget& budget,
                                      const Progress& progress = no_progress);

}  // namespace ream::fe
