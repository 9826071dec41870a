#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/hash.hpp"

namespace ream::study {

/// Random numbers that come again on every machine from the same beginning.
class SeededDraws {
 public:
  explicit SeededDraws(uint64_t beginning) : state_(beginning) {}

  /// Below `end`, which is over 0. The remainder favours no number by more than end / 2^64.
  uint64_t below(uint64_t end) { return (state_ = mix64(state_)) % end; }

  /// Fisher and Yates' shuffle.
  template <typename Value>
  void shuffle(std::vector<Value>& values) {
    for (size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  uint64_t state_;
};

}  // namespace ream::study
