#include "fe/run_labels.hpp"

namespace ream::fe {
namespace {

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

}  // namespace

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

}  // namespace ream::fe
