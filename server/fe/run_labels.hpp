#pragma once
#include <cstdint>
#include <vector>

#include "fe/voxel_mask.hpp"

namespace ream::fe {

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

}  // namespace ream::fe
