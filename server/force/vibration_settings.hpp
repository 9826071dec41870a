#pragma once
#include <filesystem>
#include <string>

namespace ream::force {

enum class VibrationSource { off, synthesized, recording };

const char* to_text(VibrationSource source);
/// Error invalid_input for any other word.
VibrationSource vibration_source_from(const std::string& text);

/// Files for VibrationSource::recording, made while reaming: WAV or CSV (see vibration_recording.hpp). Both
/// bone classes are needed; without a file the idle drill is synthesized, and cartilage always is.
struct VibrationRecordings {
  std::filesystem::path cortical, cancellous, idle;
  double rate_hz = 0.0;  ///< sampling rate of CSV files without times; others say it themselves
};

/// How the reamer's vibration is made and how much of it the hand gets.
struct VibrationSettings {
  VibrationSource source = VibrationSource::synthesized;
  VibrationRecordings recordings;
  /// Hand newtons per g of the reamer. Engineering choice: the strongest published blow, 2.6 g, makes 0.4 N.
  double vibration_n_per_g = 0.15;
  /// Limit of the vibration's own on the hand, beside that of the device. Engineering choice, hand newtons.
  double vibration_max_n = 0.5;
};

}  // namespace ream::force
