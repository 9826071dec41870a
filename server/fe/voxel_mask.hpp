#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::fe {

/// Which voxels of a grid are elements, a bit each, row after row, x fastest. A row's words have room for one
/// bit more than it has voxels, so that its corners fit into as many words.
class VoxelMask {
 public:
  VoxelMask() = default;
  /// Empty. Needs dims > 0.
  explicit VoxelMask(const Vec3i& dims);

  const Vec3i& dims() const { return dims_; }
  size_t words_per_row() const { return words_per_row_; }
  uint64_t* row(int v, int w) { return words_.data() + words_per_row_ * row_number(v, w); }
  const uint64_t* row(int v, int w) const { return words_.data() + words_per_row_ * row_number(v, w); }
  bool at(int u, int v, int w) const { return (row(v, w)[u / 64] >> (u % 64) & 1u) != 0; }
  void set(int u, int v, int w) { row(v, w)[u / 64] |= uint64_t{1} << (u % 64); }

  size_t count() const;
  size_t bytes() const { return words_.size() * sizeof(uint64_t); }
  /// What a mask of those dims takes.
  static size_t bytes_of(const Vec3i& dims);

 private:
  size_t row_number(int v, int w) const {
    return static_cast<size_t>(v) + static_cast<size_t>(dims_.y()) * static_cast<size_t>(w);
  }

  Vec3i dims_ = Vec3i::Zero();
  size_t words_per_row_ = 0;
  std::vector<uint64_t> words_;
};

/// Neighbouring rows of one layer that are worked on as one.
struct Slab {
  int w = 0, first_row = 0, end_row = 0;
};

/// A grid of rows cut into slabs, numbered in the order of the rows. Slabs of voxels and slabs of their
/// corners begin at the same rows.
struct Slabs {
  int rows_per_layer = 0, layers = 0, rows_per_slab = 1;

  size_t per_layer() const {
    return static_cast<size_t>(rows_per_layer - 1) / static_cast<size_t>(rows_per_slab) + 1;
  }
  size_t count() const { return per_layer() * static_cast<size_t>(layers); }
  Slab at(size_t i) const {
    const int first = static_cast<int>(i % per_layer()) * rows_per_slab;
    return {static_cast<int>(i / per_layer()), first, std::min(first + rows_per_slab, rows_per_layer)};
  }
};
Slabs voxel_slabs(const VoxelMask& mask);
Slabs corner_slabs(const VoxelMask& mask);

inline size_t set_bits(const uint64_t* words, size_t count) {
  size_t sum = 0;
  for (size_t i = 0; i < count; ++i) sum += static_cast<size_t>(std::popcount(words[i]));
  return sum;
}

/// Calls use(begin, end) for every run of set bits, in order.
template <typename Use>
void for_each_run(const uint64_t* words, size_t count, Use&& use) {
  bool inside = false;
  int begin = 0;
  for (size_t i = 0; i < count; ++i) {
    // Bits at which a run begins or ends: those that differ from the one before.
    const uint64_t word = words[i];
    uint64_t changes = word ^ (word << 1 | uint64_t{inside});
    for (; changes != 0; changes &= changes - 1) {
      const int at = static_cast<int>(64 * i) + std::countr_zero(changes);
      if (inside) use(begin, at);
      inside = !inside;
      begin = at;
    }
  }
  if (inside) use(begin, static_cast<int>(64 * count));
}

}  // namespace ream::fe
