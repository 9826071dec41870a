#pragma once
#include <array>
#include <cstddef>

namespace ream::test {

/// A hand on a handle: a mass that is pushed along an axis, damped by the arm and kept on its line.
/// Semi-implicit Euler; device frame. Shares nothing with the product's hands.
struct FakeHand {
  std::array<double, 3> axis{0, 0, -1}, start_mm{0, 0, 0}, place_mm{0, 0, 0}, velocity_mm_s{0, 0, 0};
  double mass_kg = 0.3, damping_n_s_mm = 0.03, sideways_n_mm = 0.5;

  void advance(double time_s, double push_n, const std::array<double, 3>& felt_n) {
    double along_mm = 0.0;
    for (size_t i = 0; i < 3; ++i) along_mm += axis[i] * (place_mm[i] - start_mm[i]);
    const double gain = time_s * 1000.0 / mass_kg;
    for (size_t i = 0; i < 3; ++i) {
      const double off_mm = place_mm[i] - start_mm[i] - axis[i] * along_mm;
      const double force_n = axis[i] * push_n + felt_n[i] - sideways_n_mm * off_mm;
      velocity_mm_s[i] = (velocity_mm_s[i] + gain * force_n) / (1.0 + gain * damping_n_s_mm);
      place_mm[i] += time_s * velocity_mm_s[i];
    }
  }
};

}  // namespace ream::test
