#include "fe/largest_component.hpp"

#include <algorithm>
#include <array>

#include "fe/keep_elements.hpp"
#include "fe/run_labels.hpp"
#include "fe/two_threads.hpp"

namespace ream::fe {
namespace {

/// One half of the layers, labelled by one thread.
struct Half {
  int first = 0, end = 0;
  LabelJoins joins;
  std::vector<uint32_t> labels;  ///< of all its runs, in order
  LayerRuns first_layer, last_layer;
};

uint64_t runs_of(const VoxelMask& mask) {
  uint64_t runs = 0;
  for (int w = 0; w < mask.dims().z(); ++w)
    for (int v = 0; v < mask.dims().y(); ++v)
      for_each_run(mask.row(v, w), mask.words_per_row(), [&](int, int) { ++runs; });
  return runs;
}

void label(const VoxelMask& mask, Half& half) {
  LayerRuns below;
  for (int w = half.first; w < half.end; ++w) {
    LayerRuns layer = label_layer(mask, w, w == half.first ? nullptr : &below, half.joins, half.labels);
    if (w == half.first) half.first_layer = layer;
    below = std::move(layer);
  }
  half.last_layer = std::move(below);
}

/// Takes the runs of a half out of the mask whose labels are not kept.
void remove_others(VoxelMask& mask, const Half& half, const LabelJoins& joins, uint32_t raise,
                   uint32_t kept) {
  size_t run = 0;
  std::vector<uint64_t> row(mask.words_per_row());
  for (int w = half.first; w < half.end; ++w)
    for (int v = 0; v < mask.dims().y(); ++v) {
      uint64_t* words = mask.row(v, w);
      std::copy_n(words, row.size(), row.begin());
      for_each_run(row.data(), row.size(), [&](int begin, int end) {
        if (joins.component(half.labels[run++] + raise) == kept) return;
        for (int u = begin; u < end; ++u) words[u / 64] &= ~(uint64_t{1} << (u % 64));
      });
    }
}

}  // namespace

ComponentCount keep_largest_component(ElementModel& model, MemoryBudget& budget, const Progress& progress) {
  VoxelMask& mask = model.mask;
  const int layers = mask.dims().z();
  const uint64_t bytes = runs_of(mask) * sizeof(uint32_t) * 2;
  budget.take(bytes, "telling the components apart");
  progress(0.0, "finding components");
  std::array<Half, 2> halves;
  halves[0].end = halves[1].first = layers / 2;
  halves[1].end = layers;
  on_two_threads(2, [&](size_t i) { label(mask, halves[i]); });
  LabelJoins& joins = halves[0].joins;
  const auto raise = static_cast<uint32_t>(joins.size());
  joins.append(halves[1].joins);
  if (layers > 1) join_layers(halves[0].last_layer, halves[1].first_layer, raise, joins);
  joins.gather();
  ComponentCount count;
  uint32_t kept = 0;
  uint64_t all = 0;
  for (uint32_t l = 0; l < joins.size(); ++l) {
    const uint64_t voxels = joins.voxels(l);
    if (voxels == 0) continue;
    ++count.components;
    all += voxels;
    if (voxels > joins.voxels(kept)) kept = l;
  }
  count.removed_voxels = all - joins.voxels(kept);
  if (count.removed_voxels > 0) {
    progress(0.5, "removing islands");
    budget.take(mask.bytes(), "removing islands");
    const VoxelMask before = mask;
    on_two_threads(2, [&](size_t i) { remove_others(mask, halves[i], joins, i == 0 ? 0 : raise, kept); });
    keep_elements(before, model, budget);
    budget.give_back(mask.bytes());
  }
  budget.give_back(bytes);
  return count;
}

}  // namespace ream::fe
