#pragma once
#include <array>
#include <span>
#include <vector>

namespace ream::force {

/// y[n] = b0 x[n] + b1 x[n-1] + b2 x[n-2] - a1 y[n-1] - a2 y[n-2].
struct Biquad {
  double b0, b1, b2, a1, a2;
};

/// Butterworth filter of order four as two sections. It is the analog filter under the bilinear transform,
/// bent so that the corner (half the power) is exact: |H|^2 = 1 / (1 + (t / t_corner)^8) for low-pass and
/// 1 / (1 + (t_corner / t)^8) for high-pass, with t = tan(pi f / rate).
/// Needs 0 < corner_hz < rate_hz / 2. Prepares vibration before the first tick, so it may use libm.
using Butterworth4 = std::array<Biquad, 2>;
Butterworth4 butterworth_low_pass(double corner_hz, double rate_hz);
Butterworth4 butterworth_high_pass(double corner_hz, double rate_hz);

/// Filters in place, from rest.
void filter_in_place(const Butterworth4& filter, std::span<double> signal);

/// `signal` at another rate, as many samples as fit. What the new rate cannot hold is taken away first: going
/// down to 1 kHz, tones up to 450 Hz stay within 1 % and those above 500 Hz are gone (-90 dB). The first
/// samples of both fall together. Ratios of 1/200 to 200. Before and after the signal there is silence.
std::vector<float> resampled(std::span<const float> signal, double from_hz, double to_hz);

/// A loop of whole beats (20 ms) at another rate, as many beats. Both rates have a whole number of samples a
/// beat.
std::vector<float> resampled_loop(std::span<const float> loop, double from_hz, double to_hz);

}  // namespace ream::force
