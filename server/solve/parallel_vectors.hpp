#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"

namespace ream::solve {

inline constexpr size_t numbers_in_part = 1 << 15;

/// Calls work(begin, end) for parts of `count` numbers, which are the same on every number of threads.
template <typename Work>
void for_parts(ThreadPool& pool, size_t count, Work&& work, size_t part = numbers_in_part) {
  pool.run((count + part - 1) / part,
           [&](size_t piece, int) { work(piece * part, std::min(count, (piece + 1) * part)); });
}

/// Sum of value(i) for i below count: part by part, then over the parts, so that the order is always the
/// same.
template <typename Value>
double sum_of(ThreadPool& pool, size_t count, Value&& value) {
  std::vector<double> sums((count + numbers_in_part - 1) / numbers_in_part);
  for_parts(pool, count, [&](size_t begin, size_t end) {
    double sum = 0.0;
    for (size_t i = begin; i < end; ++i) sum += value(i);
    sums[begin / numbers_in_part] = sum;
  });
  double all = 0.0;
  for (const double sum : sums) all += sum;
  return all;
}

}  // namespace ream::solve
