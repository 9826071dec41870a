#include "voxelizer/brick_store.hpp"

#include <algorithm>
#include <array>

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

}  // namespace ream::voxelizer
