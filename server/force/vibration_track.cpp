#include "force/vibration_track.hpp"

#include <cmath>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"
#include "force/vibration_filter.hpp"
#include "force/vibration_kinds.hpp"
#include "force/vibration_resample.hpp"

namespace ream::force {
namespace {

/// Below this a signal is called still; the smallest step of a 24-bit file is 1.2e-7 of its range.
constexpr double still = 1e-9;

constexpr size_t samples_in(double seconds) { return static_cast<size_t>(seconds * vibration_sound_rate_hz); }

/// Gravity takes the high-pass seconds to forget unless it starts with it.
void start_from_mean(std::span<double> signal) {
  const std::span<const double> first = signal.first(samples_in(1.0));
  const double mean = std::accumulate(first.begin(), first.end(), 0.0) / static_cast<double>(first.size());
  for (double& sample : signal) sample -= mean;
}

/// Whole beats whose last sample leads into the first: what follows the end fades out while the beginning
/// fades in, with constant power.
std::vector<float> looped(std::span<const double> signal) {
  const size_t seam = samples_in(vibration_seam_s);
  const size_t length = (signal.size() - seam) / sound_samples_a_beat * sound_samples_a_beat;
  std::vector<float> loop(signal.begin(), signal.begin() + static_cast<std::ptrdiff_t>(length));
  for (size_t i = 0; i < seam; ++i) {
    const double angle_rad = 0.5 * pi * static_cast<double>(i) / static_cast<double>(seam);
    loop[i] = static_cast<float>(std::sin(angle_rad) * signal[i] + std::cos(angle_rad) * signal[length + i]);
  }
  return loop;
}

void scale_to(double g_rms, std::span<float> track, const char* name) {
  const double now = rms(track);
  if (!(now > still))
    throw Error(ErrorKind::invalid_input,
                std::string(name) + " is still between 0.2 and 500 Hz; take a recording made while reaming");
  const double factor = g_rms / now;
  for (float& sample : track) sample = static_cast<float>(factor * static_cast<double>(sample));
}

}  // namespace

double rms(std::span<const float> signal) {
  double sum = 0.0;
  for (const float sample : signal) sum += static_cast<double>(sample) * static_cast<double>(sample);
  return std::sqrt(sum / static_cast<double>(signal.size()));
}

VibrationTrack prepared_vibration(std::vector<double> signal, double g_rms, const char* name) {
  if (signal.size() < samples_in(shortest_vibration_s))
    throw Error(ErrorKind::invalid_input,
                std::string(name) + " is shorter than 2 s; take a longer recording");
  start_from_mean(signal);
  filter_in_place(butterworth_high_pass(vibration_high_pass_hz, vibration_sound_rate_hz), signal);
  filter_in_place(butterworth_low_pass(vibration_low_pass_hz, vibration_sound_rate_hz), signal);
  VibrationTrack track;
  track.sound_g = looped(signal);
  scale_to(g_rms, track.sound_g, name);
  track.device_g = loop_at_tick_rate(track.sound_g);
  scale_to(g_rms, track.device_g, name);
  return track;
}

}  // namespace ream::force
