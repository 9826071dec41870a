
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/thread_pool.hpp"
#include "fe/element_model.hpp"
#include "fe/voxel_mask.hpp"

namespace ream::fe {
namespace {

/// A run of voxels in a row and the label it got; labels that met are joined.
struct LabelledRun {
  int begin = 0, end = 0;
  uint32_t label = 0;
};

/// The runs of one layer, row after row.
struct LayerRuns {
  std::vector<LabelledRun> runs;
  std::vector<size_t> row_begin;  ///< of each row, and the end
};

/// Labels of runs and which of them are one component: the least label of a component stands for it.
class LabelJoins {
 public:
  uint32_t add(uint64_t voxels);
  void add_voxels(uint32_t label, uint64_t voxels) { voxels_[label] += voxels; }
  uint32_t root(uint32_t label);
  void join(uint32_t a, uint32_t b);
  size_t size() const { return parent_.size(); }
  uint64_t voxels(uint32_t label) const { return voxels_[label]; }
  /// Appends the labels of another numbering, raised by size().
  void append(const LabelJoins& other);
  /// Gathers the voxels of each component at its root. From here on component() may be asked.
  void gather();
  uint32_t component(uint32_t label) const { return parent_[label]; }

 private:
  std::vector<uint32_t> parent_;
  std::vector<uint64_t> voxels_;
};

/// Labels the runs of a layer, given those of the layer below (or null) and appends their labels to `labels`.
LayerRuns label_layer(const VoxelMask& mask, int w, const LayerRuns* below, LabelJoins& joins,
                      std::vector<uint32_t>& labels);

/// Joins the labels of runs that touch across two layers.
void join_layers(const LayerRuns& below, const LayerRuns& above, uint32_t raise_above, LabelJoins& joins);

/// Calls touch(run, other) for every pair of runs that overlap; both lists lie in order.
template <typename Runs, typename Touch>
void for_each_touch(Runs run, Runs run_end, const LabelledRun* other, const LabelledRun* other_end,
                    Touch&& touch) {
  while (run != run_end && other != other_end) {
    if (run->begin < other->end && other->begin < run->end) touch(*run, *other);
    if (run->end < other->end)
      ++run;
    else
      ++other;
  }
}

constexpr uint32_t no_label = UINT32_MAX;

uint32_t LabelJoins::add(uint64_t voxels) {
  parent_.push_back(static_cast<uint32_t>(parent_.size()));
  voxels_.push_back(voxels);
  return parent_.back();
}

uint32_t LabelJoins::root(uint32_t label) {
  while (parent_[label] != label) {
    parent_[label] = parent_[parent_[label]];
    label = parent_[label];
  }
  return label;
}

void LabelJoins::join(uint32_t a, uint32_t b) {
  a = root(a);
  b = root(b);
  if (a != b) parent_[std::max(a, b)] = std::min(a, b);
}

void LabelJoins::append(const LabelJoins& other) {
  const auto raise = static_cast<uint32_t>(size());
  for (const uint32_t parent : other.parent_) parent_.push_back(parent + raise);
  voxels_.insert(voxels_.end(), other.voxels_.begin(), other.voxels_.end());
}

void LabelJoins::gather() {
  for (uint32_t label = 0; label < parent_.size(); ++label) {
    const uint32_t to = root(label);
    parent_[label] = to;
    if (to == label) continue;
    voxels_[to] += voxels_[label];
    voxels_[label] = 0;
  }
}

LayerRuns label_layer(const VoxelMask& mask, int w, const LayerRuns* below, LabelJoins& joins,
                      std::vector<uint32_t>& labels) {
  LayerRuns layer;
  const int rows = mask.dims().y();
  for (int v = 0; v < rows; ++v) {
    const size_t first = layer.runs.size();
    layer.row_begin.push_back(first);
    for_each_run(mask.row(v, w), mask.words_per_row(), [&](int begin, int end) {
      layer.runs.push_back({begin, end, no_label});
    });
    LabelledRun *const run = layer.runs.data() + first, *const run_end =
                                                            layer.runs.data() + layer.runs.size();
    const auto touch = [&](LabelledRun& here, const LabelledRun& there) {
      if (here.label == no_label)
        here.label = there.label;
      else
        joins.join(here.label, there.label);
    };
    const auto row = static_cast<size_t>(v);
    if (v > 0) for_each_touch(run, run_end, layer.runs.data() + layer.row_begin[row - 1], run, touch);
    if (below != nullptr)
      for_each_touch(run, run_end, below->runs.data() + below->row_begin[row],
                     below->runs.data() + below->row_begin[row + 1], touch);
    for (LabelledRun* r = run; r != run_end; ++r) {
      const auto voxels = static_cast<uint64_t>(r->end - r->begin);
      if (r->label == no_label)
        r->label = joins.add(voxels);
      else
        joins.add_voxels(r->label, voxels);
      labels.push_back(r->label);
    }
  }
  layer.row_begin.push_back(layer.runs.size());
  return layer;
}

void join_layers(const LayerRuns& below, const LayerRuns& above, uint32_t raise_above, LabelJoins& joins) {
  for (size_t row = 0; row + 1 < above.row_begin.size(); ++row)
    for_each_touch(above.runs.data() + above.row_begin[row], above.runs.data() + above.row_begin[row + 1],
                   below.runs.data() + below.row_begin[row], below.runs.data() + below.row_begin[row + 1],
                   [&](const LabelledRun& here, const LabelledRun& there) {
                     joins.join(here.label + raise_above, there.label);
                   });
}

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
  parallel_for(2, 2, [&](size_t i) { label(mask, halves[i]); });
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
    parallel_for(2, 2, [&](size_t i) { remove_others(mask, halves[i], joins, i == 0 ? 0 : raise, kept); });
    keep_elements(before, model, budget);
    budget.give_back(mask.bytes());
  }
  budget.give_back(bytes);
  return count;
}

}  // namespace ream::fe
