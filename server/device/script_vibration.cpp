#include "device/script_vibration.hpp"

#include "core/json_reader.hpp"

namespace ream::device {
namespace {

constexpr double slowest_rate_hz = 1000.0, fastest_rate_hz = 1.0e6, most_n_per_g = 5.0;

void parse_recordings(JsonReader& reader, ScriptVibration& vibration) {
  const auto file = [&](const std::string& key) {
    const std::string name = reader.text(key);
    if (name.empty()) reader.refuse(key, "must name a .wav or .csv file");
    return name;
  };
  vibration.cortical_file = file("cortical_file");
  vibration.cancellous_file = file("cancellous_file");
  if (reader.has("idle_file")) vibration.idle_file = file("idle_file");
  if (reader.has("rate_hz")) vibration.rate_hz = reader.number("rate_hz", slowest_rate_hz, fastest_rate_hz);
}

}  // namespace

void ScriptVibration::resolve(const std::filesystem::path& folder) {
  for (std::filesystem::path* file : {&cortical_file, &cancellous_file, &idle_file})
    if (!file->empty()) *file = folder / *file;
}

ScriptVibration parse_vibration(JsonReader reader) {
  ScriptVibration vibration;
  vibration.source = reader.text_or("source", vibration.source);
  if (vibration.source != "synthesized" && vibration.source != "recording" && vibration.source != "off")
    reader.refuse("source", "must be 'synthesized', 'recording' or 'off'");
  if (vibration.source == "recording") parse_recordings(reader, vibration);
  vibration.n_per_g = reader.number_or("n_per_g", vibration.n_per_g, 0.0, most_n_per_g);
  reader.finish();
  return vibration;
}

}  // namespace ream::device
