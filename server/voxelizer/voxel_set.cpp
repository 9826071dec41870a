#include "voxelizer/voxel_set.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

#include "core/vector_clones.hpp"

namespace ream::voxelizer {
namespace {

constexpr int edge = 8;
constexpr size_t brick_bytes = 64;

uint8_t byte_of(const uint32_t* row, uint32_t number) {
  return static_cast<uint8_t>(row[number / 4] >> (8 * (number % 4)));
}

}  // namespace

void BrickStore::take(const TileRows& rows) {
  lines_.clear();
  runs_.clear();
  bits_.clear();
  lines_v_ = (rows.range.v_end - rows.range.v_begin + edge - 1) / edge;
  for (int w = rows.range.w_begin; w < rows.range.w_end; w += edge)
    for (int v = rows.range.v_begin; v < rows.range.v_end; v += edge) take_line(rows, v, w);
  if (runs_.empty()) lines_.clear();
  lines_.shrink_to_fit();
  runs_.shrink_to_fit();
  bits_.shrink_to_fit();
}

void BrickStore::take_line(const TileRows& rows, int v, int w) {
  Line line{static_cast<uint32_t>(runs_.size()), 0, bits_.size() / brick_bytes};
  const int v_end = std::min(v + edge, rows.range.v_end), w_end = std::min(w + edge, rows.range.w_end);
  for (size_t word = 0; word < rows.words_per_row; ++word) {
    uint32_t any = 0;
    for (int j = w; j < w_end; ++j)
      for (int i = v; i < v_end; ++i) any |= rows.row(i, j)[word];
    if (any == 0) continue;
    for (uint32_t brick = static_cast<uint32_t>(4 * word); brick < 4 * (word + 1); ++brick) {
      std::array<uint8_t, brick_bytes> bits{};
      for (int j = w; j < w_end; ++j)
        for (int i = v; i < v_end; ++i)
          bits[static_cast<size_t>(edge * (j - w) + i - v)] = byte_of(rows.row(i, j), brick);
      if (std::all_of(bits.begin(), bits.end(), [](uint8_t b) { return b == 0; })) continue;
      const bool full = std::all_of(bits.begin(), bits.end(), [](uint8_t b) { return b == 0xff; });
      const bool has_run = runs_.size() > line.first_run;
      if (full && has_run && runs_.back().full > 0 && runs_.back().first + runs_.back().full == brick) {
        ++runs_.back().full;
        continue;
      }
      runs_.push_back({brick, full ? 1u : 0u});
      if (!full) bits_.insert(bits_.end(), bits.begin(), bits.end());
    }
  }
  line.runs = static_cast<uint32_t>(runs_.size()) - line.first_run;
  lines_.push_back(line);
}

size_t BrickStore::bytes() const {
  return lines_.size() * sizeof(Line) + runs_.size() * sizeof(Run) + bits_.size();
}

bool BrickStore::read_row(int v, int w, std::span<uint32_t> words) const {
  std::fill(words.begin(), words.end(), 0u);
  if (lines_.empty()) return false;
  const Line& line = lines_[static_cast<size_t>(v / edge + lines_v_ * (w / edge))];
  size_t partial = line.first_bits;
  const size_t place = static_cast<size_t>(edge * (w % edge) + v % edge);
  uint32_t any = 0;
  for (uint32_t r = line.first_run; r < line.first_run + line.runs; ++r) {
    const Run& run = runs_[r];
    const uint32_t byte = run.full > 0 ? 0xffu : bits_[brick_bytes * partial++ + place];
    any |= byte;
    for (uint32_t brick = run.first; brick < run.first + std::max(run.full, 1u); ++brick)
      words[brick / 4] |= byte << (8 * (brick % 4));
  }
  return any != 0;
}

VoxelSet::VoxelSet(const RasterGrid& grid, size_t max_dense_bytes) : grid_(grid) {
  const double bytes = 4.0 * static_cast<double>(grid.words_per_row()) * static_cast<double>(grid.rows());
  if (bytes <= static_cast<double>(max_dense_bytes))
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

uint64_t count_marked(const TileRows& rows, ThreadPool& pool) {
  constexpr int layers_a_piece = 16;
  const int layers = rows.range.w_end - rows.range.w_begin;
  const auto pieces = static_cast<size_t>((layers + layers_a_piece - 1) / layers_a_piece);
  std::vector<uint64_t> sums(pieces);
  pool.run(pieces, [&](size_t piece, int) {
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
