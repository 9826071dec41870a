#include "score/smoothness.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace ream::score {
namespace {

constexpr double highest_hz = 10.0, least_amplitude = 0.05;
constexpr int padding_octaves = 4;
constexpr size_t least_samples = 3;  // for a second difference

/// Greatest absolute speed; empty for what cannot be judged.
std::optional<double> peak_of(std::span<const double> speed, double rate_hz) {
  if (speed.size() < least_samples || !(rate_hz > 0.0)) return std::nullopt;
  double peak = 0.0;
  for (const double v : speed) {
    if (!std::isfinite(v)) return std::nullopt;
    peak = std::max(peak, std::abs(v));
  }
  return peak > 0.0 ? std::optional(peak) : std::nullopt;
}

/// Magnitudes of the spectrum up to half the rate, zero-padded, divided by the greatest.
std::vector<double> normalized_spectrum(std::span<const double> speed, double peak, size_t padded) {
  std::vector<double> samples(padded, 0.0);
  std::transform(speed.begin(), speed.end(), samples.begin(), [&](double v) { return v / peak; });
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  fft.fwd(spectrum, samples);
  std::vector<double> magnitudes(spectrum.size());
  std::transform(spectrum.begin(), spectrum.end(), magnitudes.begin(),
                 [](const std::complex<double>& z) { return std::abs(z); });
  const double greatest = *std::max_element(magnitudes.begin(), magnitudes.end());
  for (double& m : magnitudes) m /= greatest;
  return magnitudes;
}

}  // namespace

std::optional<double> spectral_arc_length(std::span<const double> speed, double rate_hz) {
  const auto peak = peak_of(speed, rate_hz);
  if (!peak) return std::nullopt;
  const double octaves = std::ceil(std::log2(static_cast<double>(speed.size())));
  const size_t padded = size_t{1} << (static_cast<int>(octaves) + padding_octaves);
  const std::vector<double> magnitude = normalized_spectrum(speed, *peak, padded);
  const double step_hz = rate_hz / static_cast<double>(padded);
  size_t first = magnitude.size(), last = 0;
  for (size_t k = 0; k < magnitude.size() && static_cast<double>(k) * step_hz <= highest_hz; ++k) {
    if (magnitude[k] < least_amplitude) continue;
    first = std::min(first, k);
    last = k;
  }
  if (first >= last) return std::nullopt;
  const double step = 1.0 / static_cast<double>(last - first);
  double length = 0.0;
  for (size_t k = first; k < last; ++k) {
    const double rise = magnitude[k + 1] - magnitude[k];
    length += std::sqrt(step * step + rise * rise);
  }
  return -length;
}

std::optional<double> log_dimensionless_jerk(std::span<const double> speed, double rate_hz) {
  const auto peak = peak_of(speed, rate_hz);
  if (!peak) return std::nullopt;
  const double dt = 1.0 / rate_hz;
  double sum = 0.0;
  for (size_t i = 2; i < speed.size(); ++i) {
    const double jerk = (speed[i] - 2.0 * speed[i - 1] + speed[i - 2]) / (*peak * dt * dt);
    sum += jerk * jerk;
  }
  if (!(sum > 0.0)) return std::nullopt;
  const double duration_s = static_cast<double>(speed.size()) * dt;
  return -std::log(duration_s * duration_s * duration_s * sum * dt);
}

}  // namespace ream::score
