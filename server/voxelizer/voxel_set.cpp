#include "voxelizer/voxel_set.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace ream::voxelizer {

VoxelSet::VoxelSet(const RasterGrid& grid, size_t most_dense_bytes) : grid_(grid) {
  const double bytes = 4.0 * static_cast<double>(grid.words_per_row()) * static_cast<double>(grid.rows());
  if (bytes <= static_cast<double>(most_dense_bytes))
    words_ = std::make_unique_for_overwrite<uint32_t[]>(word_count());
}

size_t VoxelSet::bytes() const {
  if (!sparse()) return word_count() * sizeof(uint32_t);
  size_t sum = bricks_.size() * sizeof(BrickStore);
  for (const BrickStore& store : bricks_) sum += store.bytes();
  return sum;
}

bool VoxelSet::read_row(int v, int w, std::span<uint32_t> words) const {
  if (sparse()) return bricks_[plan_.tile_of(v, w)].read_row(v % plan_.rows, w % plan_.layers, words);
  const size_t row = static_cast<size_t>(v) + static_cast<size_t>(grid_.dims.y()) * static_cast<size_t>(w);
  std::memcpy(words.data(), words_.get() + row * words.size(), words.size_bytes());
  return std::any_of(words.begin(), words.end(), [](uint32_t word) { return word != 0; });
}

bool VoxelSet::marked(int u, int v, int w) const {
  std::vector<uint32_t> row(grid_.words_per_row());
  return read_row(v, w, row) && ((row[static_cast<size_t>(u) / 32] >> (u % 32)) & 1u) != 0;
}

void VoxelSet::begin_bricks(const TilePlan& plan) {
  plan_ = plan;
  bricks_ = std::vector<BrickStore>(plan.count());
}

uint64_t count_marked(const TileRows& rows) {
  uint64_t sum = 0;
  const size_t words = rows.words_per_row * static_cast<size_t>(rows.range.v_end - rows.range.v_begin);
  for (int w = rows.range.w_begin; w < rows.range.w_end; ++w) {
    const uint32_t* layer = rows.row(rows.range.v_begin, w);
    for (size_t i = 0; i < words; ++i) sum += static_cast<uint64_t>(std::popcount(layer[i]));
  }
  return sum;
}

void clear(const TileRows& rows) {
  const size_t words = rows.words_per_row * static_cast<size_t>(rows.range.v_end - rows.range.v_begin);
  for (int w = rows.range.w_begin; w < rows.range.w_end; ++w)
    std::memset(rows.row(rows.range.v_begin, w), 0, words * sizeof(uint32_t));
}

}  // namespace ream::voxelizer
