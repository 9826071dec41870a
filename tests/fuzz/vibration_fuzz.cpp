// Vibration recordings: WAV and CSV.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "reader/vibration_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const bool wav = input.byte() % 2 != 0;
  try {
    const auto file = fuzz::folder().write(wav ? "a.wav" : "a.csv", input.rest());
    const auto recording = reader::read_vibration_file(file, input.empty() ? 0.0 : 5000.0);
    fuzz::require(
        recording.rate_hz >= force::min_recording_hz && recording.rate_hz <= force::max_recording_hz,
        "a rate beyond its limits was taken");
    fuzz::require(std::all_of(recording.samples.begin(), recording.samples.end(),
                              [](double sample) { return std::isfinite(sample); }),
                  "a sample that is no number was taken");
  } catch (const Error&) {
  }
  return 0;
}
