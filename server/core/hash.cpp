#include "core/hash.hpp"

namespace ream {

uint64_t hash_bytes(std::span<const std::byte> bytes, uint64_t seed) {
  uint64_t rolling = hash_combine(seed, bytes.size());
  size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    uint64_t word = 0;
    for (size_t k = 0; k < 8; ++k) word |= std::to_integer<uint64_t>(bytes[i + k]) << (8 * k);
    rolling = hash_combine(rolling, word);
  }
  uint64_t tail = 0;
  for (size_t k = 0; i + k < bytes.size(); ++k) tail |= std::to_integer<uint64_t>(bytes[i + k]) << (8 * k);
  return hash_combine(rolling, tail);
}

uint64_t hash_text(std::string_view text, uint64_t seed) {
  return hash_bytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

std::string to_hex(uint64_t value) {
  constexpr char digits[] = "0123456789abcdef";
  std::string hex(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4) hex[static_cast<size_t>(i)] = digits[value & 15];
  return hex;
}

}  // namespace ream
