#pragma once
#include <span>
#include <vector>

namespace ream::force {

/// `signal` at another rate, as many samples as fit. What the new rate cannot hold is taken away first: going
/// down to 1 kHz, tones up to 450 Hz stay within 1 % and those above 500 Hz are gone (-90 dB). The first
/// samples of both fall together. Ratios of 1/200 to 200. Before and after the signal there is silence.
std::vector<float> resampled(std::span<const float> signal, double from_hz, double to_hz);

/// A loop of 22,050 Hz (a whole number of beats of 441 samples) as a loop of 1 kHz (as many beats of 20).
std::vector<float> loop_at_tick_rate(std::span<const float> loop);

}  // namespace ream::force
