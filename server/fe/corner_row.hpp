#pragma once
#include <vector>

#include "fe/node_numbering.hpp"

namespace ream::fe {

/// One row of corners with the ids of its nodes.
class CornerRow {
 public:
  /// `first_id`: of the row's first node. Returns that of the row after it.
  uint64_t load(const NodeNumbering& numbering, int v, int w, uint64_t first_id) {
    const size_t count = numbering.mask().words_per_row();
    words_.resize(count);
    before_.resize(count);
    numbering.corner_row(v, w, words_.data());
    first_id_ = first_id;
    count_ = 0;
    for (size_t i = 0; i < count; ++i) {
      before_[i] = count_;
      count_ += static_cast<uint32_t>(std::popcount(words_[i]));
    }
    return first_id + count_;
  }

  uint64_t first_id() const { return first_id_; }
  uint32_t count() const { return count_; }
  const std::vector<uint64_t>& words() const { return words_; }
  bool has(int u) const { return (words_[static_cast<size_t>(u) / 64] >> (u % 64) & 1u) != 0; }
  /// Nodes of the row before corner u.
  uint32_t rank(int u) const {
    const size_t i = static_cast<size_t>(u) / 64;
    return before_[i] + static_cast<uint32_t>(std::popcount(words_[i] & ((uint64_t{1} << (u % 64)) - 1)));
  }

 private:
  std::vector<uint64_t> words_;
  std::vector<uint32_t> before_;
  uint64_t first_id_ = 0;
  uint32_t count_ = 0;
};

/// Calls use(v, begin, end, rows) for every run of elements in a slab of voxels, in order; rows are the four
/// corner rows around them: (v,w), (v+1,w), (v,w+1), (v+1,w+1). `Row` is CornerRow or has its load().
template <typename Row, typename Use>
void for_each_element_run(const NodeNumbering& numbering, size_t slab_number, Use&& use) {
  const Slab slab = numbering.voxels().at(slab_number);
  const size_t across = static_cast<size_t>(slab.first_row / numbering.corners().rows_per_slab);
  uint64_t next_id[2];
  for (size_t k = 0; k < 2; ++k)
    next_id[k] = 1 + numbering.nodes_before(
                         (static_cast<size_t>(slab.w) + k) * numbering.corners().per_layer() + across);
  Row rows[4];  // (v, w), (v + 1, w), (v, w + 1), (v + 1, w + 1)
  for (int k = 0; k < 2; ++k)
    next_id[k] = rows[2 * k + 1].load(numbering, slab.first_row, slab.w + k, next_id[k]);
  for (int v = slab.first_row; v < slab.end_row; ++v) {
    for (int k = 0; k < 2; ++k) {
      std::swap(rows[2 * k], rows[2 * k + 1]);
      next_id[k] = rows[2 * k + 1].load(numbering, v + 1, slab.w + k, next_id[k]);
    }
    for_each_run(numbering.mask().row(v, slab.w), numbering.mask().words_per_row(),
                 [&](int begin, int end) { use(v, begin, end, rows); });
  }
}

/// Calls use(v, row) for every row of a slab of corners, in order.
template <typename Use>
void for_each_corner_row(const NodeNumbering& numbering, size_t slab_number, Use&& use) {
  const Slab slab = numbering.corners().at(slab_number);
  uint64_t next_id = 1 + numbering.nodes_before(slab_number);
  CornerRow row;
  for (int v = slab.first_row; v < slab.end_row; ++v) {
    next_id = row.load(numbering, v, slab.w, next_id);
    use(v, slab.w, row);
  }
}

}  // namespace ream::fe
