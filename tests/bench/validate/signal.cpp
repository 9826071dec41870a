#include "bench/validate/signal.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.hpp"

namespace ream::bench {
namespace {

constexpr size_t second = 1000, highest_hz = 499, neighbours = 20;

}  // namespace

double root_mean_square(std::span<const double> signal) {
  double squares = 0.0;
  for (const double v : signal) squares += v * v;
  return signal.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(signal.size()));
}

std::vector<double> peak_to_peak(std::span<const double> signal, size_t window) {
  std::vector<double> found;
  for (size_t start = 0; start + window <= signal.size(); start += window) {
    const auto [low, high] =
        std::minmax_element(signal.begin() + static_cast<std::ptrdiff_t>(start),
                            signal.begin() + static_cast<std::ptrdiff_t>(start + window));
    found.push_back(*high - *low);
  }
  return found;
}

std::vector<double> periodogram(std::span<const double> signal) {
  std::array<double, second> cosine, sine;
  for (size_t i = 0; i < second; ++i) {
    const double angle = 2.0 * pi * static_cast<double>(i) / static_cast<double>(second);
    cosine[i] = std::cos(angle);
    sine[i] = std::sin(angle);
  }
  const size_t seconds = signal.size() / second;
  std::vector<double> power(highest_hz, 0.0);
  for (size_t s = 0; s < seconds; ++s)
    for (size_t hz = 1; hz <= highest_hz; ++hz) {
      double re = 0.0, im = 0.0;
      for (size_t i = 0; i < second; ++i) {
        const size_t turn = hz * i % second;
        re += signal[s * second + i] * cosine[turn];
        im += signal[s * second + i] * sine[turn];
      }
      // One-sided density of a bin of 1 Hz: twice the square of the Fourier sum over the square of its
      // length.
      power[hz - 1] += 2.0 * (re * re + im * im) / static_cast<double>(second * second * seconds);
    }
  return power;
}

double line_strength(std::span<const double> power) {
  double strongest = 0.0;
  for (size_t i = 0; i < power.size(); ++i) {
    const size_t from = i < neighbours ? 0 : i - neighbours, to = std::min(power.size(), i + neighbours + 1);
    std::vector<double> around;
    for (size_t k = from; k < to; ++k)
      if (k != i) around.push_back(power[k]);
    const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
    std::nth_element(around.begin(), middle, around.end());
    if (*middle > 0.0) strongest = std::max(strongest, power[i] / *middle);
  }
  return strongest;
}

}  // namespace ream::bench
