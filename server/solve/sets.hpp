#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace ream::solve {

/// Disjoint sets of numbers that grow together (union-find).
class Sets {
 public:
  explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  /// The least number of the set that has `i`.
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace ream::solve
