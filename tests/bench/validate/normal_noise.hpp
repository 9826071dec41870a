#pragma once
#include <cmath>
#include <cstdint>
#include <random>

#include "core/units.hpp"

namespace ream::bench {

/// Random numbers that follow from a seed alone, the same on every machine.
class NormalNoise {
 public:
  explicit NormalNoise(uint64_t seed) : random_(seed) {}

  /// At least `low`, less than `high`.
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  /// Of mean 0 and standard deviation 1 (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - between(0.0, 1.0)));
    return radius * std::cos(2.0 * pi * between(0.0, 1.0));
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace ream::bench
