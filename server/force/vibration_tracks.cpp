#include "force/vibration_tracks.hpp"

#include <future>
#include <map>
#include <mutex>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "force/vibration_recording.hpp"
#include "force/vibration_resample.hpp"
#include "force/vibration_synthesizer.hpp"

namespace ream::force {
namespace {

using Files = std::array<std::filesystem::path, vibration_kinds>;

VibrationTrack synthesized_track(VibrationKind kind, uint64_t seed) {
  const double g_rms = vibration_levels[static_cast<size_t>(kind)].g_rms;
  return prepared_vibration(synthesized_vibration(kind, seed), g_rms, "the synthesized vibration");
}

VibrationTrack recorded_track(VibrationKind kind, const std::filesystem::path& file, double rate_hz) {
  VibrationRecording recording = read_vibration_recording(file, rate_hz);
  if (recording.rate_hz != vibration_sound_rate_hz) {
    const std::vector<float> raw(recording.samples.begin(), recording.samples.end());
    const std::vector<float> fitting = resampled(raw, recording.rate_hz, vibration_sound_rate_hz);
    recording.samples.assign(fitting.begin(), fitting.end());
  }
  const double g_rms = vibration_levels[static_cast<size_t>(kind)].g_rms;
  return prepared_vibration(std::move(recording.samples), g_rms, file.c_str());
}

/// Kinds side by side: making one takes a fifth of a second. A kind without a file is synthesized.
std::shared_ptr<const VibrationTracks> made(const Files& files, double rate_hz, uint64_t seed) {
  std::array<std::future<VibrationTrack>, vibration_kinds> parts;
  for (size_t k = 0; k < vibration_kinds; ++k)
    parts[k] = std::async(std::launch::async, [&files, rate_hz, seed, k] {
      const auto kind = static_cast<VibrationKind>(k);
      return files[k].empty() ? synthesized_track(kind, seed) : recorded_track(kind, files[k], rate_hz);
    });
  auto tracks = std::make_shared<VibrationTracks>();
  for (size_t k = 0; k < vibration_kinds; ++k) tracks->by_kind[k] = parts[k].get();
  return tracks;
}

std::shared_ptr<const VibrationTracks> synthesized(uint64_t seed) {
  static std::mutex mutex;
  static std::map<uint64_t, std::weak_ptr<const VibrationTracks>> living;
  const std::lock_guard lock(mutex);
  std::erase_if(living, [](const auto& entry) { return entry.second.expired(); });
  if (const auto found = living.find(seed); found != living.end())
    if (auto tracks = found->second.lock()) return tracks;
  auto tracks = made({}, 0.0, seed);
  living[seed] = tracks;
  return tracks;
}

Files files_of(const VibrationRecordings& recordings) {
  if (recordings.cortical.empty() || recordings.cancellous.empty())
    throw Error(ErrorKind::invalid_input,
                "vibration from recordings needs both cortical_file and cancellous_file");
  return {recordings.cancellous, recordings.cortical, {}, recordings.idle};
}

}  // namespace

const char* to_text(VibrationSource source) {
  switch (source) {
    case VibrationSource::off:
      return "off";
    case VibrationSource::synthesized:
      return "synthesized";
    case VibrationSource::recording:
      return "recording";
  }
  return "";
}

VibrationSource vibration_source_from(const std::string& text) {
  for (const auto source : {VibrationSource::off, VibrationSource::synthesized, VibrationSource::recording})
    if (text == to_text(source)) return source;
  throw Error(ErrorKind::invalid_input,
              "vibration source '" + text + "' must be synthesized, recording or off");
}

uint64_t VibrationTracks::hash() const {
  uint64_t rolling = 0;
  for (const VibrationTrack& track : by_kind) {
    rolling = hash_bytes(std::as_bytes(std::span(track.sound_g)), rolling);
    rolling = hash_bytes(std::as_bytes(std::span(track.device_g)), rolling);
  }
  return rolling;
}

std::shared_ptr<const VibrationTracks> make_vibration_tracks(const VibrationSettings& settings,
                                                             uint64_t seed) {
  switch (settings.source) {
    case VibrationSource::off:
      return nullptr;
    case VibrationSource::synthesized:
      return synthesized(seed);
    case VibrationSource::recording:
      return made(files_of(settings.recordings), settings.recordings.rate_hz, seed);
  }
  return nullptr;
}

}  // namespace ream::force
