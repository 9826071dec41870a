#include "voxelizer/voxel_set.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "core/vector_clones.hpp"

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

TileRows VoxelSet::rows_of(const RowRange& range, std::vector<uint32_t>& memory) {
  TileRows rows;
  rows.range = range;
  rows.words_per_row = grid_.words_per_row();
  if (sparse()) {
    rows.rows_per_layer = static_cast<size_t>(range.v_end - range.v_begin);
    memory.resize(rows.words_per_row * range.rows());
    rows.words = memory.data();
    return rows;
  }
  rows.rows_per_layer = static_cast<size_t>(grid_.dims.y());
  rows.words = words_.get() + rows.words_per_row * (static_cast<size_t>(range.v_begin) +
                                                    rows.rows_per_layer * static_cast<size_t>(range.w_begin));
  return rows;
}

REAM_VECTOR_CLONES uint64_t count_marked(const TileRows& rows) {
  uint64_t sum = 0;
  const size_t words = rows.words_per_row * static_cast<size_t>(rows.range.v_end - rows.range.v_begin);
  for (int w = rows.range.w_begin; w < rows.range.w_end; ++w) {
    const uint32_t* layer = rows.row(rows.range.v_begin, w);
    size_t i = 0;
    for (; i + 8 <= words; i += 8) {
      uint64_t bits[4];
      std::memcpy(bits, layer + i, sizeof bits);
      if ((bits[0] | bits[1] | bits[2] | bits[3]) == 0) continue;
      for (const uint64_t b : bits) sum += static_cast<uint64_t>(std::popcount(b));
    }
    for (; i < words; ++i) sum += static_cast<uint64_t>(std::popcount(layer[i]));
  }
  return sum;
}

uint64_t count_marked(const TileRows& rows, Crew& crew) {
  constexpr int layers_a_piece = 16;
  const int layers = rows.range.w_end - rows.range.w_begin;
  const auto pieces = static_cast<size_t>((layers + layers_a_piece - 1) / layers_a_piece);
  std::vector<uint64_t> sums(pieces);
  crew.run(pieces, [&](size_t piece, int) {
    TileRows part = rows;
    part.range.w_begin += static_cast<int>(piece) * layers_a_piece;
    part.range.w_end = std::min(part.range.w_begin + layers_a_piece, rows.range.w_end);
    part.words = rows.row(rows.range.v_begin, part.range.w_begin);
    sums[piece] = count_marked(part);
  });
  return std::accumulate(sums.begin(), sums.end(), uint64_t{0});
}

void clear(const TileRows& rows) {
  const size_t words = rows.words_per_row * static_cast<size_t>(rows.range.v_end - rows.range.v_begin);
  for (int w = rows.range.w_begin; w < rows.range.w_end; ++w)
    std::memset(rows.row(rows.range.v_begin, w), 0, words * sizeof(uint32_t));
}

}  // namespace ream::voxelizer
