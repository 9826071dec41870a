#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"
#include "kernels/layout.h"

namespace ream::solve {

inline constexpr size_t numbers_in_part = REAM_SOLVE_PART, sum_lanes = REAM_SOLVE_LANES;

/// Calls work(begin, end) for parts of `count` numbers, which are the same on every number of threads.
template <typename Work>
void for_parts(ThreadPool& pool, size_t count, Work&& work, size_t part = numbers_in_part) {
  pool.run((count + part - 1) / part,
           [&](size_t piece, int) { work(piece * part, std::min(count, (piece + 1) * part)); });
}

/// Sum of value(i) for i below count: each part in lanes, then over the parts, so that the order is always
/// the same, also on a device (kernels/solver_vectors.cl).
template <typename Value>
double sum_of(ThreadPool& pool, size_t count, Value&& value) {
  std::vector<double> sums((count + numbers_in_part - 1) / numbers_in_part);
  for_parts(pool, count, [&](size_t begin, size_t end) {
    std::array<double, sum_lanes> lanes{};
    for (size_t first = begin; first < end; first += sum_lanes) {
      const size_t some = std::min(sum_lanes, end - first);
      for (size_t lane = 0; lane < some; ++lane) lanes[lane] += value(first + lane);
    }
    for (size_t half = sum_lanes / 2; half > 0; half /= 2)
      for (size_t lane = 0; lane < half; ++lane) lanes[lane] += lanes[lane + half];
    sums[begin / numbers_in_part] = lanes[0];
  });
  double all = 0.0;
  for (const double sum : sums) all += sum;
  return all;
}

}  // namespace ream::solve
