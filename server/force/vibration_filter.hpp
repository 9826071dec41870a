#pragma once
#include <array>
#include <span>

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

}  // namespace ream::force
