#pragma once
#include <functional>
#include <span>

#include "core/progress.hpp"
#include "fe/element_model.hpp"
#include "fe/memory_budget.hpp"

namespace ream::fe {

/// Which voxels of a layer become elements: their gray code, or `no_element`; x fastest, dims.x * dims.y of
/// them. Called twice for every layer, from two threads, in any order.
using LayerReader = std::function<void(int w, std::span<int32_t> codes)>;
inline constexpr int32_t no_element = -1;

/// Mask and codes of a model whose other fields are set already.
void fill_from_layers(ElementModel& model, const Vec3i& dims, const LayerReader& read, MemoryBudget& budget,
                      const Progress& progress = no_progress);

/// Takes elements whose gray value is below the threshold out of the model.
void remove_below(ElementModel& model, double threshold, MemoryBudget& budget);

}  // namespace ream::fe
