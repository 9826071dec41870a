#pragma once
#include <cstdint>

namespace ream::shell {

/// Interleaves the low 10 bits of u, v, w (u lowest): thesis section 4.3.
constexpr uint32_t spread_bits_10(uint32_t x) {
  x &= 0x3ff;
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  return (x | (x << 2)) & 0x09249249;
}
constexpr uint32_t gather_bits_10(uint32_t x) {
  x &= 0x09249249;
  x = (x | (x >> 2)) & 0x030c30c3;
  x = (x | (x >> 4)) & 0x0300f00f;
  x = (x | (x >> 8)) & 0x030000ff;
  return (x | (x >> 16)) & 0x3ff;
}
/// Each coordinate 0 to 1023.
constexpr uint32_t morton_code(uint32_t u, uint32_t v, uint32_t w) {
  return spread_bits_10(u) | (spread_bits_10(v) << 1) | (spread_bits_10(w) << 2);
}

}  // namespace ream::shell
