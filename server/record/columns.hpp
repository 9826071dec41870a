#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ream::record {

/// Rows of 32-bit words, stored so that zstd finds what they have in common. Any words come back exactly.
///
/// Per column one byte: how a word w[i] became the residual r[i], all modulo 2^32, words before the first row
/// being 0:
///   0  r = w[i]
///   1  r = zigzag(w[i] - w[i-1])
///   2  r = zigzag(w[i] - 2 w[i-1] + w[i-2])
///   3  r = w[i] xor w[i-1]
/// with zigzag(d) = 2 d for d below 2^31, else 2 (2^32 - d) - 1. After these bytes, column by column, the
/// residuals as four planes: the highest byte of every row, then the second highest, and so on.
///
/// `words`: row after row of `columns` words.
void put_columns(std::vector<std::byte>& out, std::span<const uint32_t> words, uint32_t columns);

/// The inverse. False when `in` is not exactly that many rows and columns or a byte names no such way;
/// nothing is allocated then.
bool take_columns(std::span<const std::byte> in, uint32_t rows, uint32_t columns,
                  std::vector<uint32_t>& words);

}  // namespace ream::record
