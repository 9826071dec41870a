#pragma once
#include <filesystem>
#include <string>

#include "force/vibration/vibration_recording.hpp"

namespace ream::reader {

using force::VibrationRecording;

/// The file of force::read_vibration_recording(), read in this process. Errors: invalid_input.
VibrationRecording read_vibration_file(const std::filesystem::path& path, double rate_hz);

/// The CSV form of it; `where` names the text in errors.
VibrationRecording parse_vibration_csv(const std::string& text, double rate_hz, const std::string& where);

}  // namespace ream::reader
