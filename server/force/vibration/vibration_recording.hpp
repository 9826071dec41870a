#pragma once
#include <filesystem>
#include <vector>

namespace ream::force {

/// A vibration signal as somebody recorded it. The unit does not matter: preparation scales it.
struct VibrationRecording {
  std::vector<double> samples;
  double rate_hz = 0.0;
};

/// Limits of what is taken as a recording.
inline constexpr double min_recording_hz = 1000.0, max_recording_hz = 1.0e6;
inline constexpr size_t max_recording_samples = 20'000'000;

/// Reads one channel, by ream-reader, from a WAV file, or from a CSV file of either form:
///   one column of g, with or without the heading `g`; the sampling rate is `rate_hz`;
///   the heading `time_s,g`, then times and g, evenly spaced to half a step; the rate comes from the times.
/// Errors: not_found; invalid_input naming file, line and remedy: neither .wav nor .csv, more than one
/// channel, anything that is no finite number, uneven times, no rate, a rate or length beyond the limits
/// above.
VibrationRecording read_vibration_recording(const std::filesystem::path& path, double rate_hz);

}  // namespace ream::force
