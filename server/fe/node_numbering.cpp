#include "fe/node_numbering.hpp"

#include <numeric>
#include <string>

#include "core/error.hpp"
#include "fe/two_threads.hpp"

namespace ream::fe {
namespace {

/// Counts of slabs to sums before them; one more at the end with the whole.
void sum_up(std::vector<uint64_t>& counts) {
  counts.push_back(0);
  std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), uint64_t{0});
}

}  // namespace

NodeNumbering::NodeNumbering(const VoxelMask& mask)
    : mask_(mask),
      voxels_(voxel_slabs(mask)),
      corners_(corner_slabs(mask)),
      elements_before_(voxels_.count()),
      nodes_before_(corners_.count()) {
  const size_t words = mask.words_per_row();
  on_two_threads(corners_.per_layer() > 0 ? static_cast<size_t>(corners_.layers) : 0, [&](size_t layer) {
    std::vector<uint64_t> row(words);
    for (size_t i = layer * corners_.per_layer(); i < (layer + 1) * corners_.per_layer(); ++i) {
      const Slab slab = corners_.at(i);
      for (int v = slab.first_row; v < slab.end_row; ++v) {
        corner_row(v, slab.w, row.data());
        nodes_before_[i] += set_bits(row.data(), words);
      }
    }
    if (static_cast<int>(layer) == voxels_.layers) return;
    for (size_t i = layer * voxels_.per_layer(); i < (layer + 1) * voxels_.per_layer(); ++i) {
      const Slab slab = voxels_.at(i);
      elements_before_[i] = set_bits(mask.row(slab.first_row, slab.w),
                                     words * static_cast<size_t>(slab.end_row - slab.first_row));
    }
  });
  sum_up(elements_before_);
  sum_up(nodes_before_);
  if (nodes() > greatest_id)
    throw Error(ErrorKind::invalid_input,
                "the mesh would have " + std::to_string(nodes()) +
                    " nodes, and solvers take ids up to 999,999,999; give a smaller "
                    "region or less upsampling");
}

void NodeNumbering::corner_row(int v, int w, uint64_t* words) const {
  const size_t count = mask_.words_per_row();
  std::fill(words, words + count, 0);
  for (int dw = -1; dw <= 0; ++dw)
    for (int dv = -1; dv <= 0; ++dv) {
      if (v + dv < 0 || v + dv >= mask_.dims().y() || w + dw < 0 || w + dw >= mask_.dims().z()) continue;
      const uint64_t* row = mask_.row(v + dv, w + dw);
      for (size_t i = 0; i < count; ++i) words[i] |= row[i];
    }
  uint64_t carried = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint64_t last = words[i] >> 63;
    words[i] |= words[i] << 1 | carried;
    carried = last;
  }
}

}  // namespace ream::fe
