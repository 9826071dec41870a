#pragma once
#include <array>
#include <cstdint>

#include "geometry/vec.hpp"

namespace ream::device {

/// Physiological tremor as a force, N: noise between 8 and 12 Hz, alike and independent in the three
/// directions. Random numbers are counted, not drawn: sample i depends on seed and i only. Arithmetic is
/// + - x and square roots, so a seed gives the same samples on every machine.
class Tremor {
 public:
  /// `rms_n`: root mean square of each component.
  Tremor(uint64_t seed, double rms_n);

  /// Starts the same sequence again. Runs the filter in, so that the first sample is like any other.
  void begin() noexcept;
  /// The next tick's force.
  Vec3 next() noexcept;

 private:
  /// Transposed direct form II of one second-order section with zeros at 0 Hz and the Nyquist frequency.
  struct Section {
    double s1 = 0.0, s2 = 0.0;
    double run(double x, double a1, double a2) noexcept;
  };
  static double filtered(std::array<Section, 2>& sections, double x) noexcept;

  uint64_t seed_;
  uint64_t counter_ = 0;
  double gain_;  ///< from noise in -1..1 to newtons
  std::array<std::array<Section, 2>, 3> sections_{};
};

}  // namespace ream::device
