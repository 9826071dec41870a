#include "force/vibration/vibration_synthesizer.hpp"

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "force/vibration/vibration_signal.hpp"
#include "force/vibration/vibration_tracks.hpp"

namespace ream::force {
namespace {

/// End of the rising part of the spectrum: fingers feel up to 400 Hz (thesis 5.3). Hz.
constexpr double colour_corner_hz = 400.0;
/// Part of the power that comes in blows. Engineering choice: enough of them that each window of five seconds
/// has one near the largest, and still a rustle between them.
constexpr double share_of_blows = 0.9;
/// Blows are this strong at least, as part of the strongest; evenly spread between. Engineering choice.
constexpr double weakest_blow = 0.25;
/// What half of peak-to-peak in five seconds is made of: the strongest of the blows in them after lip-pass
/// modulation, as part of the strongest there can be, and a multiple of the noise's own g_rms. Found by
/// measuring 100 seeds at both rates; their means lie 4 % on either side of what was asked for.
constexpr double reach_of_blows = 0.965, reach_of_noise = 3.3;
/// Part of the time between blows in which the next may fall: two never come together and add up.
constexpr double play_of_blows = 0.8;
/// The end is faded into a beginning without blows: otherwise two could meet.
constexpr double first_blow_s = vibration_seam_s;

/// Even numbers from a 64-bit counter (splitmix64).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t bits() {
    const uint64_t out = mix64(state_);
    state_ += 0x9e3779b97f4a7c15ull;
    return out;
  }
  /// At least 0, below 1.
  double even() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

 private:
  uint64_t state_;
};

/// Power rises with the square of the frequency, then falls.
void colour(std::vector<double>& signal) {
  double before = 0.0;
  for (double& sample : signal) {
    const double now = sample;
    sample = now - before;
    before = now;
  }
  filter_in_place(butterworth_low_pass(colour_corner_hz, vibration_sound_rate_hz), signal);
}

/// What one blow of size 1 becomes once coloured and prepared.
struct Blow {
  double peak = 0.0;    ///< largest deflection to either side
  size_t delay = 0;     ///< samples from the blow to its peak
  double energy = 0.0;  ///< sum of squares
};

Blow blow() {
  std::vector<double> response(static_cast<size_t>(0.1 * vibration_sound_rate_hz), 0.0);
  response[0] = 1.0;
  colour(response);
  filter_in_place(butterworth_low_pass(vibration_low_pass_hz, vibration_sound_rate_hz), response);
  Blow blow;
  for (size_t i = 0; i < response.size(); ++i) {
    blow.energy += response[i] * response[i];
    if (std::abs(response[i]) <= blow.peak) continue;
    blow.peak = std::abs(response[i]);
    blow.delay = i;
  }
  return blow;
}

/// One blow in each of equal spans of time, at a random tick of it; signs come in pairs. Peaks lie on ticks:
/// at 1 kHz a peak between two samples would be lost to the hand.
void add_blows(std::vector<double>& signal, double strongest, double samples_a_blow, size_t delay,
               Random& random) {
  constexpr double samples_a_tick = static_cast<double>(sound_samples_a_beat) / ticks_a_beat;
  double sign = 1.0;
  for (size_t i = 0;; ++i) {
    const double peak_at = first_blow_s * vibration_sound_rate_hz +
                           (static_cast<double>(i) + play_of_blows * random.even()) * samples_a_blow;
    const double size = strongest * (weakest_blow + (1.0 - weakest_blow) * random.even());
    sign = i % 2 == 0 ? (random.bits() >> 63 != 0 ? 1.0 : -1.0) : -sign;
    const double on_tick = std::round(std::floor(peak_at / samples_a_tick) * samples_a_tick);
    if (on_tick >= static_cast<double>(signal.size())) return;
    signal[static_cast<size_t>(on_tick) - delay] += sign * size;
  }
}

}  // namespace

std::vector<double> synthesized_vibration(VibrationKind kind, uint64_t seed) {
  const VibrationLevel& level = vibration_levels[static_cast<size_t>(kind)];
  Random random(hash_combine(seed, static_cast<uint64_t>(kind)));
  const Blow blow_of_one = blow();
  const double blows_share = level.peak_to_peak_g > 0.0 ? share_of_blows : 0.0;
  const double power_g2 = level.g_rms * level.g_rms;

  // Even noise of +-w has variance w^2 / 3; the filter multiplies it by the energy of its response.
  const double noise = std::sqrt(3.0 * (1.0 - blows_share) * power_g2 / blow_of_one.energy);
  std::vector<double> signal(
      static_cast<size_t>((level.seconds + vibration_seam_s) * vibration_sound_rate_hz));
  for (double& sample : signal) sample = noise * (2.0 * random.even() - 1.0);

  if (blows_share > 0.0) {
    const double noise_g_rms = std::sqrt((1.0 - blows_share) * power_g2);
    const double strongest_g = (0.5 * level.peak_to_peak_g - reach_of_noise * noise_g_rms) / reach_of_blows;
    const double strongest = strongest_g / blow_of_one.peak;
    const double mean_square_part = (1.0 + weakest_blow + weakest_blow * weakest_blow) / 3.0;
    const double energy_of_a_blow = strongest * strongest * mean_square_part * blow_of_one.energy;
    add_blows(signal, strongest, energy_of_a_blow / (blows_share * power_g2), blow_of_one.delay, random);
  }
  colour(signal);
  return signal;
}

}  // namespace ream::force
