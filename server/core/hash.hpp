#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ream {

/// Finalizer of splitmix64 (Steele, Lea, Flood 2014): a bijection of 64-bit words with full avalanche.
constexpr uint64_t mix64(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Folds `value` into a rolling hash; the order of calls matters.
constexpr uint64_t hash_combine(uint64_t rolling, uint64_t value) { return mix64(rolling ^ mix64(value)); }

/// Hash of a byte string; the same on every machine.
uint64_t hash_bytes(std::span<const std::byte> bytes, uint64_t seed = 0);
uint64_t hash_text(std::string_view text, uint64_t seed = 0);

/// 16 lower-case hex digits.
std::string to_hex(uint64_t value);

}  // namespace ream
