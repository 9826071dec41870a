#pragma once
#include <filesystem>
#include <string>

namespace ream {
class JsonReader;
}

namespace ream::device {

/// What a script says about the reamer's vibration (force/vibration_settings.hpp says what it means).
struct ScriptVibration {
  std::string source = "synthesized";                               ///< synthesized, recording or off
  std::filesystem::path cortical_file, cancellous_file, idle_file;  ///< WAV or CSV, for recording
  double rate_hz = 0.0;   ///< of CSV files without times; 0: not said
  double n_per_g = 0.15;  ///< hand newtons per g

  /// Files as they are found from `folder`, where the script lies.
  void resolve(const std::filesystem::path& folder);
};

/// The script's key "vibration". Errors: invalid_input naming place and key.
ScriptVibration parse_vibration(JsonReader reader);

}  // namespace ream::device
