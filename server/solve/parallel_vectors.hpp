#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"

namespace ream::solve {

/// Calls work(begin, end) for parts of `count` numbers, which are the same on every number of threads.
template <typename Work>
void for_parts(ThreadPool& pool, size_t count, Work&& work, size_t part = 1 << 15) {
  pool.run((count + part - 1) / part,
           [&](size_t piece, int) { work(piece * part, std::min(count, (piece + 1) * part)); });
}

/// Sum of value(i) for i below count: part by part, then over the parts, so that the order is always the
/// same.
template <typename Value>
double sum_of(ThreadPool& pool, size_t count, Value&& value) {
  constexpr size_t part = 1 << 15;
  std::vector<double> sums((count + part - 1) / part);
  pool.run(sums.size(), [&](size_t piece, int) {
    double sum = 0.0;
    for (size_t i = piece * part; i < std::min(count, (piece + 1) * part); ++i) sum += value(i);
    sums[piece] = sum;
  });
  double all = 0.0;
  for (const double sum : sums) all += sum;
  return all;
}

}  // namespace ream::solve
