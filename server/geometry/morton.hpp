#pragma once
#include <cstdint>

namespace ream {

/// Interleaves the low 21 bits of u, v, w (u lowest) into 63 bits: thesis section 4.3, whose 10 bits in 32
/// end at 1024 cells a side; for coordinates below 1024 the codes are the thesis' own.
constexpr uint64_t spread_bits(uint64_t x) {
  x &= 0x1fffff;
  x = (x | (x << 32)) & 0x001f00000000ffffull;
  x = (x | (x << 16)) & 0x001f0000ff0000ffull;
  x = (x | (x << 8)) & 0x100f00f00f00f00full;
  x = (x | (x << 4)) & 0x10c30c30c30c30c3ull;
  return (x | (x << 2)) & 0x1249249249249249ull;
}
constexpr uint32_t gather_bits(uint64_t x) {
  x &= 0x1249249249249249ull;
  x = (x | (x >> 2)) & 0x10c30c30c30c30c3ull;
  x = (x | (x >> 4)) & 0x100f00f00f00f00full;
  x = (x | (x >> 8)) & 0x001f0000ff0000ffull;
  x = (x | (x >> 16)) & 0x001f00000000ffffull;
  return static_cast<uint32_t>((x | (x >> 32)) & 0x1fffff);
}
/// Each coordinate 0 to 2^21 - 1.
constexpr uint64_t morton_code(uint32_t u, uint32_t v, uint32_t w) {
  return spread_bits(u) | (spread_bits(v) << 1) | (spread_bits(w) << 2);
}

}  // namespace ream
