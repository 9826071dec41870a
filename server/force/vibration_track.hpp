#pragma once
#include <span>
#include <vector>

namespace ream::force {

/// Acceleration of the tool in g as a loop without a seam, at two rates. Both have the same g_rms.
struct VibrationTrack {
  std::vector<float> sound_g;   ///< 22,050 Hz, a whole number of beats of 441 samples
  std::vector<float> device_g;  ///< 1 kHz, as many beats of 20 samples
};

/// Time in which the end of a signal gives way to its beginning: the track is this much shorter. Seconds.
inline constexpr double vibration_seam_s = 0.5;
/// Shortest signal that can be prepared, s.
inline constexpr double shortest_vibration_s = 2.0;

/// The one way from a raw signal at 22,050 Hz, in any unit, to a track (thesis 5.3): Butterworth of order
/// four, high-pass 0.2 Hz and low-pass 500 Hz; end faded into beginning; resampled to 1 kHz; each rate scaled
/// to `g_rms`. Same input, same bits on one machine; it uses libm, and nothing that decides depends on it.
/// `signal` is used up. `name` tells people what it was. Errors: invalid_input when it is shorter than
/// shortest_vibration_s or still.
VibrationTrack prepared_vibration(std::vector<double> signal, double g_rms, const char* name);

/// Root of the mean square.
double rms(std::span<const float> signal);

}  // namespace ream::force
