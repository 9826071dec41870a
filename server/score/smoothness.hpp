#pragma once
#include <optional>
#include <span>

namespace ream::score {

// Smoothness of one movement by its speed, sampled evenly at `rate_hz`. Both are without unit and more
// negative for less smooth movements (Balasubramanian et al. 2015, as their program computes them). Empty for
// speeds that are all zero, not finite, or too few.

/// SPARC: length of the arc of the speed's normalized spectrum, to 10 Hz or where it last reaches 5 % of its
/// peak. Zero-padded to 2^(ceil(log2 N) + 4) samples.
std::optional<double> spectral_arc_length(std::span<const double> speed, double rate_hz);

/// LDLJ: -ln of T^3 / peak^2 times the integral of the second derivative of speed squared.
std::optional<double> log_dimensionless_jerk(std::span<const double> speed, double rate_hz);

}  // namespace ream::score
