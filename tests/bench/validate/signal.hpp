#pragma once
#include <span>
#include <vector>

namespace ream::bench {

/// A value a tick (1 kHz).
using Signal = std::vector<double>;

double root_mean_square(std::span<const double> signal);

/// Largest less smallest value of each whole window of `window` samples.
std::vector<double> peak_to_peak(std::span<const double> signal, size_t window);

/// Periodogram: power per Hz at 1, 2, ... 499 Hz, mean over the whole seconds of the signal.
std::vector<double> periodogram(std::span<const double> signal);

/// How far the strongest frequency stands out: the largest value of a periodogram over the median of the 40
/// frequencies around it. Chance alone keeps it below 2 where a minute was averaged.
double line_strength(std::span<const double> periodogram);

}  // namespace ream::bench
