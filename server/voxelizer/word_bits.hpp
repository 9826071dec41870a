#pragma once
#include <cstdint>
#include <cstring>

namespace ream::voxelizer {

/// Sets bits low to high of a row.
inline void set_bits(uint32_t* row, int low, int high) {
  const int first = low >> 5, last = high >> 5;
  const uint32_t from = ~0u << (low & 31), to = ~0u >> (31 - (high & 31));
  if (first == last) {
    row[first] |= from & to;
    return;
  }
  row[first] |= from;
  for (int i = first + 1; i < last; ++i) row[i] = ~0u;
  row[last] |= to;
}

/// Sets those of 64 bits that begin with a word.
inline void set_two_words(uint32_t* words, long long bits) {
  long long there;
  std::memcpy(&there, words, sizeof there);
  there |= bits;
  std::memcpy(words, &there, sizeof there);
}

}  // namespace ream::voxelizer
