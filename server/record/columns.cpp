#include "record/columns.hpp"

#include <bit>

namespace ream::record {
namespace {

enum Way : uint8_t { as_is, difference, second_difference, exclusive_or, ways };

uint32_t zigzag(uint32_t d) { return (d << 1) ^ (0u - (d >> 31)); }
uint32_t unzigzag(uint32_t z) { return (z >> 1) ^ (0u - (z & 1)); }

/// `before`: the word of the row before, `earlier`: of the row before that.
uint32_t residual(uint8_t way, uint32_t word, uint32_t before, uint32_t earlier) {
  switch (way) {
    case difference: return zigzag(word - before);
    case second_difference: return zigzag(word - 2 * before + earlier);
    case exclusive_or: return word ^ before;
    default: return word;
  }
}

uint32_t word_of(uint8_t way, uint32_t r, uint32_t before, uint32_t earlier) {
  switch (way) {
    case difference: return unzigzag(r) + before;
    case second_difference: return unzigzag(r) + 2 * before - earlier;
    case exclusive_or: return r ^ before;
    default: return r;
  }
}

/// The way whose residuals have the fewest bits in all.
uint8_t best_way(std::span<const uint32_t> column) {
  uint64_t bits[ways] = {};
  uint32_t before = 0, earlier = 0;
  for (const uint32_t word : column) {
    for (uint8_t way = 0; way < ways; ++way)
      bits[way] += static_cast<uint64_t>(std::bit_width(residual(way, word, before, earlier)));
    earlier = before;
    before = word;
  }
  uint8_t best = as_is;
  for (uint8_t way = 1; way < ways; ++way)
    if (bits[way] < bits[best]) best = way;
  return best;
}

}  // namespace

void put_columns(std::vector<std::byte>& out, std::span<const uint32_t> words, uint32_t columns) {
  const size_t rows = columns == 0 ? 0 : words.size() / columns;
  const size_t ways_at = out.size();
  out.resize(ways_at + columns + 4 * rows * columns);
  std::byte* plane = out.data() + ways_at + columns;
  std::vector<uint32_t> column(rows);
  for (uint32_t c = 0; c < columns; ++c) {
    for (size_t row = 0; row < rows; ++row) column[row] = words[row * columns + c];
    const uint8_t way = best_way(column);
    out[ways_at + c] = static_cast<std::byte>(way);
    uint32_t before = 0, earlier = 0;
    for (size_t row = 0; row < rows; ++row) {
      const uint32_t r = residual(way, column[row], before, earlier);
      for (size_t k = 0; k < 4; ++k) plane[k * rows + row] = static_cast<std::byte>(r >> (8 * (3 - k)));
      earlier = before;
      before = column[row];
    }
    plane += 4 * rows;
  }
}

bool take_columns(std::span<const std::byte> in, uint32_t rows, uint32_t columns,
                  std::vector<uint32_t>& words) {
  const uint64_t count = uint64_t{rows} * columns;
  if (in.size() < columns || (in.size() - columns) / 4 != count || (in.size() - columns) % 4 != 0)
    return false;
  for (uint32_t c = 0; c < columns; ++c)
    if (std::to_integer<uint8_t>(in[c]) >= ways) return false;
  words.resize(count);
  const std::byte* plane = in.data() + columns;
  for (uint32_t c = 0; c < columns; ++c) {
    const auto way = std::to_integer<uint8_t>(in[c]);
    uint32_t before = 0, earlier = 0;
    for (size_t row = 0; row < rows; ++row) {
      uint32_t r = 0;
      for (size_t k = 0; k < 4; ++k) r = r << 8 | std::to_integer<uint32_t>(plane[k * size_t{rows} + row]);
      const uint32_t word = word_of(way, r, before, earlier);
      words[row * columns + c] = word;
      earlier = before;
      before = word;
    }
    plane += 4 * size_t{rows};
  }
  return true;
}

}  // namespace ream::record
