#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/units.hpp"

namespace ream::test {

/// Squared magnitude of the discrete Fourier sum of `signal` at one frequency, divided by its length squared:
/// a^2 / 4 for a tone of amplitude a that fits.
template <typename Number>
double power_at(std::span<const Number> signal, double frequency_hz, double rate_hz) {
  double re = 0.0, im = 0.0;
  for (size_t i = 0; i < signal.size(); ++i) {
    const double angle_rad = 2.0 * pi * std::fmod(frequency_hz * static_cast<double>(i) / rate_hz, 1.0);
    re += static_cast<double>(signal[i]) * std::cos(angle_rad);
    im += static_cast<double>(signal[i]) * std::sin(angle_rad);
  }
  const auto n = static_cast<double>(signal.size());
  return (re * re + im * im) / (n * n);
}

/// Power by Welch's method in bins of 1 Hz up to 500 Hz, for a signal of 1 kHz: segments of one second under
/// a Hann window that overlap by half. The scale is free.
inline std::vector<double> welch_1khz(std::span<const double> signal) {
  constexpr size_t n = 1000;
  std::vector<double> cosine(n), bins(n / 2 + 1, 0.0), part(n);
  for (size_t i = 0; i < n; ++i) cosine[i] = std::cos(2.0 * pi * static_cast<double>(i) / n);
  for (size_t start = 0; start + n <= signal.size(); start += n / 2) {
    for (size_t i = 0; i < n; ++i) part[i] = signal[start + i] * (0.5 - 0.5 * cosine[i]);
    for (size_t f = 0; f < bins.size(); ++f) {
      double re = 0.0, im = 0.0;
      for (size_t i = 0, turn = 0; i < n; ++i, turn = (turn + f) % n) {
        re += part[i] * cosine[turn];
        im += part[i] * cosine[(turn + 3 * n / 4) % n];
      }
      bins[f] += re * re + im * im;
    }
  }
  return bins;
}

/// Power between two whole frequencies, Hz, of welch_1khz.
inline double band_power(const std::vector<double>& bins, size_t from_hz, size_t to_hz) {
  double sum = 0.0;
  for (size_t f = from_hz; f < to_hz; ++f) sum += bins[f];
  return sum;
}

/// How far the most prominent bin between 20 and 450 Hz stands above its surroundings: its power over the
/// median of the 30 bins around it. A minute of noise without a line stays below 1.5.
inline double most_prominent_line(const std::vector<double>& bins) {
  constexpr size_t reach = 15;
  double most = 0.0;
  for (size_t f = 20; f <= 450; ++f) {
    std::vector<double> around;
    for (size_t g = f - reach; g <= f + reach; ++g)
      if (g != f) around.push_back(bins[g]);
    std::nth_element(around.begin(), around.begin() + reach, around.end());
    most = std::max(most, bins[f] / around[reach]);
  }
  return most;
}

}  // namespace ream::test
