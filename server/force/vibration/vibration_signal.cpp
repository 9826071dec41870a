#include "force/vibration/vibration_signal.hpp"

#include <samplerate.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
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

std::vector<float> converted(std::span<const float> signal, double ratio, int converter) {
  // Rounded up with room to spare; the converter says how many it made.
  std::vector<float> out(static_cast<size_t>(std::ceil(static_cast<double>(signal.size()) * ratio)) + 2);
  SRC_DATA data{};
  data.data_in = signal.data();
  data.input_frames = static_cast<long>(signal.size());
  data.data_out = out.data();
  data.output_frames = static_cast<long>(out.size());
  data.src_ratio = ratio;
  if (const int fault = src_simple(&data, converter, 1); fault != 0)
    throw Error(ErrorKind::invalid_input,
                std::string("a vibration signal cannot be resampled: ") + src_strerror(fault));
  out.resize(static_cast<size_t>(data.output_frames_gen));
  return out;
}

constexpr double beat_s = 0.02;

/// Going far down, a first step to this many times the new rate may be coarse (its passband is 80 %), which
/// leaves the dear filter little to do.
constexpr double coarse_step_times = 2.205;

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

std::vector<float> resampled(std::span<const float> signal, double from_hz, double to_hz) {
  if (from_hz == to_hz) return {signal.begin(), signal.end()};
  const double between_hz = coarse_step_times * to_hz;
  if (from_hz < 2.0 * between_hz) return converted(signal, to_hz / from_hz, SRC_SINC_BEST_QUALITY);
  const std::vector<float> coarse = converted(signal, between_hz / from_hz, SRC_SINC_FASTEST);
  return converted(coarse, to_hz / between_hz, SRC_SINC_BEST_QUALITY);
}

std::vector<float> resampled_loop(std::span<const float> loop, double from_hz, double to_hz) {
  // The filters see the loop go on at both ends; what they make of the borders is cut off again.
  constexpr size_t border_beats = 25;
  const auto beat_from = static_cast<size_t>(std::lround(from_hz * beat_s));
  const auto beat_to = static_cast<size_t>(std::lround(to_hz * beat_s));
  const size_t border = border_beats * beat_from;
  std::vector<float> longer(loop.size() + 2 * border);
  for (size_t i = 0; i < longer.size(); ++i)
    longer[i] = loop[(i + border_beats * loop.size() - border) % loop.size()];
  const std::vector<float> out = resampled(longer, from_hz, to_hz);
  const auto first = out.begin() + static_cast<std::ptrdiff_t>(border_beats * beat_to);
  return {first, first + static_cast<std::ptrdiff_t>(loop.size() / beat_from * beat_to)};
}

}  // namespace ream::force
