#include "force/vibration_filter.hpp"

#include <cmath>

#include "core/units.hpp"

namespace ream::force {
namespace {

/// The two pole pairs of order four lie on the unit circle at these angles from the negative real axis.
constexpr std::array<double, 2> pole_angle_rad{pi / 8.0, 3.0 * pi / 8.0};

enum class Band { low, high };

Butterworth4 butterworth(Band band, double corner_hz, double rate_hz) {
  const double t = std::tan(pi * corner_hz / rate_hz);
  Butterworth4 filter;
  for (size_t i = 0; i < filter.size(); ++i) {
    const double damping = 2.0 * std::cos(pole_angle_rad[i]) * t;
    const double scale = 1.0 / (1.0 + damping + t * t);
    const double gain = band == Band::low ? t * t * scale : scale;
    filter[i].b0 = filter[i].b2 = gain;
    filter[i].b1 = band == Band::low ? 2.0 * gain : -2.0 * gain;
    filter[i].a1 = 2.0 * (t * t - 1.0) * scale;
    filter[i].a2 = (1.0 - damping + t * t) * scale;
  }
  return filter;
}

}  // namespace

Butterworth4 butterworth_low_pass(double corner_hz, double rate_hz) {
  return butterworth(Band::low, corner_hz, rate_hz);
}

Butterworth4 butterworth_high_pass(double corner_hz, double rate_hz) {
  return butterworth(Band::high, corner_hz, rate_hz);
}

void filter_in_place(const Butterworth4& filter, std::span<double> signal) {
  for (const Biquad& section : filter) {
    double first = 0.0, second = 0.0;  // transposed direct form II
    for (double& sample : signal) {
      const double x = sample;
      const double y = section.b0 * x + first;
      first = section.b1 * x - section.a1 * y + second;
      second = section.b2 * x - section.a2 * y;
      sample = y;
    }
  }
}

}  // namespace ream::force
