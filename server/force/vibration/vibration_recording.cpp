#include "force/vibration/vibration_recording.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/json_reader.hpp"
#include "isolation/isolated_job.hpp"

namespace ream::force {

VibrationRecording read_vibration_recording(const std::filesystem::path& path, double rate_hz) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed))
    throw Error(ErrorKind::not_found, "there is no vibration recording " + path.string());
  constexpr uint64_t max_bytes = max_recording_samples * sizeof(double);
  isolation::IsolatedJob job;
  job.task = "vibration";
  job.input = path;
  job.options = {{"rate_hz", rate_hz}};
  job.limits.file_bytes = max_bytes;
  const isolation::IsolatedResult result = isolation::run_isolated(job);
  JsonReader answer(result.answer(), "the answer of the reader");
  VibrationRecording recording{result.values<double>("samples", max_bytes), answer.number("rate_hz")};
  const bool finite = std::all_of(recording.samples.begin(), recording.samples.end(),
                                  [](double sample) { return std::isfinite(sample); });
  if (!finite || recording.samples.size() < 2 || !(recording.rate_hz >= min_recording_hz) ||
      !(recording.rate_hz <= max_recording_hz))
    throw Error(ErrorKind::io, "the reader answered with an impossible recording");
  return recording;
}

}  // namespace ream::force
