#include "force/vibration/vibration_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/signal_handlers.hpp"
#include "core/units.hpp"
#include "force/coefficients.hpp"
#include "force/vibration/vibration_recording.hpp"
#include "force/vibration/vibration_signal.hpp"

namespace ream::force {
namespace {

/// Lips that pass bone at a mean radius break a chip a correlation length l: the spectrum rises up to their
/// speed over l. Mean radius of the thesis' reamer of 36.5 mm, mm; l as bone is built (0.2 mm cortical, 0.5
/// mm between trabeculae), twice as long in cartilage: engineering choices, mm.
constexpr double mean_lip_radius_mm = 2.0 / 3.0 * 18.25;
constexpr std::array<double, vibration_kinds> correlation_mm{0.5, 0.2, 1.0, 0.5};

double corner_hz(VibrationKind kind) {
  return reference_spindle_rad_s * mean_lip_radius_mm / correlation_mm[static_cast<size_t>(kind)];
}

/// The shortest time that is a whole number of samples at 22,050 Hz and of ticks.
constexpr size_t samples_a_beat = 441;

/// Part of the power that comes in blows. Engineering choice: enough of them that each window of five seconds
/// has one near the largest, and still a rustle between them.
constexpr double share_of_blows = 0.9;
/// Blows are this strong at least, as part of the strongest; evenly spread between. Engineering choice.
constexpr double weakest_blow = 0.25;
/// What half of peak-to-peak in five seconds is made of: the strongest of the blows in them after lip-pass
/// modulation, as part of the strongest there can be, and a multiple of the noise's own g_rms. Found by
/// measuring; means over twelve windows lie within 4 % of what was asked for.
constexpr double reach_of_blows = 0.965, reach_of_noise = 3.3;
/// Part of the time between blows in which the next may fall: two never come together and add up.
constexpr double play_of_blows = 0.8;
/// The end is faded into a beginning without blows: otherwise two could meet.
constexpr double first_blow_s = vibration_seam_s;

/// Even numbers from a 64-bit counter (splitmix64).
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t bits() {
    const uint64_t out = mix64(state_);
    state_ += 0x9e3779b97f4a7c15ull;
    return out;
  }
  /// At least 0, below 1.
  double even() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

 private:
  uint64_t state_;
};

/// Power rises with the square of the frequency up to the corner, then falls.
void colour(VibrationKind kind, std::vector<double>& signal) {
  double before = 0.0;
  for (double& sample : signal) {
    const double now = sample;
    sample = now - before;
    before = now;
  }
  filter_in_place(butterworth_low_pass(corner_hz(kind), vibration_raw_rate_hz), signal);
}

/// What one blow of size 1 becomes once coloured and prepared.
struct Blow {
  double peak = 0.0;    ///< largest deflection to either side, where it falls on a tick, at 1 kHz
  size_t delay = 0;     ///< raw samples from the blow to its peak
  double energy = 0.0;  ///< sum of squares of raw samples
  double kept = 0.0;    ///< part of the energy that 1 kHz holds
};

/// A blow that begins at that raw sample, coloured and filtered as a track is.
std::vector<double> blow_at(VibrationKind kind, size_t first) {
  std::vector<double> response(20 * samples_a_beat, 0.0);
  response[first] = 1.0;
  colour(kind, response);
  filter_in_place(butterworth_low_pass(vibration_low_pass_hz, vibration_raw_rate_hz), response);
  return response;
}

Blow blow(VibrationKind kind) {
  const auto larger = [](auto a, auto b) { return std::abs(a) < std::abs(b); };
  Blow blow;
  const std::vector<double> raw = blow_at(kind, 0);
  for (const double sample : raw) blow.energy += sample * sample;
  blow.delay = static_cast<size_t>(std::max_element(raw.begin(), raw.end(), larger) - raw.begin());
  const std::vector<double> on_tick = blow_at(kind, 10 * samples_a_beat - blow.delay);
  const std::vector<float> felt =
      resampled(std::vector<float>(on_tick.begin(), on_tick.end()), vibration_raw_rate_hz, 1.0 / tick_s);
  blow.peak = std::abs(*std::max_element(felt.begin(), felt.end(), larger));
  const double power = rms(felt) * rms(felt);
  blow.kept = power * static_cast<double>(raw.size()) / blow.energy;
  return blow;
}

/// One blow in each of equal spans of time, at a random tick of it; signs come in pairs. Peaks lie on ticks:
/// at 1 kHz a peak between two samples would be lost to the hand. (So it is at other speeds than the
/// experiments'.)
void add_blows(std::vector<double>& signal, double strongest, double samples_a_blow, size_t delay,
               Random& random) {
  constexpr double samples_a_tick = vibration_raw_rate_hz * tick_s;
  double sign = 1.0;
  for (size_t i = 0;; ++i) {
    const double peak_at = first_blow_s * vibration_raw_rate_hz +
                           (static_cast<double>(i) + play_of_blows * random.even()) * samples_a_blow;
    const double size = strongest * (weakest_blow + (1.0 - weakest_blow) * random.even());
    sign = i % 2 == 0 ? (random.bits() >> 63 != 0 ? 1.0 : -1.0) : -sign;
    const double on_tick = std::round(std::floor(peak_at / samples_a_tick) * samples_a_tick);
    if (on_tick >= static_cast<double>(signal.size())) return;
    signal[static_cast<size_t>(on_tick) - delay] += sign * size;
  }
}

/// Below this a signal is called still; the smallest step of a 24-bit file is 1.2e-7 of its range.
constexpr double still = 1e-9;

/// Sets a specimen apart from what else comes from the seed.
constexpr uint64_t specimen_of_seed = 0x200;

constexpr size_t samples_in(double seconds) { return static_cast<size_t>(seconds * vibration_raw_rate_hz); }

/// Gravity takes the high-pass seconds to forget unless it starts with it.
void start_from_mean(std::span<double> signal) {
  const std::span<const double> first = signal.first(samples_in(1.0));
  const double mean = std::accumulate(first.begin(), first.end(), 0.0) / static_cast<double>(first.size());
  for (double& sample : signal) sample -= mean;
}

/// Whole beats whose last sample leads into the first: what follows the end fades out while the beginning
/// fades in, with constant power.
std::vector<float> looped(std::span<const double> signal) {
  const size_t seam = samples_in(vibration_seam_s);
  const size_t length = (signal.size() - seam) / samples_a_beat * samples_a_beat;
  std::vector<float> loop(signal.begin(), signal.begin() + static_cast<std::ptrdiff_t>(length));
  for (size_t i = 0; i < seam; ++i) {
    const double angle_rad = 0.5 * pi * static_cast<double>(i) / static_cast<double>(seam);
    loop[i] = static_cast<float>(std::sin(angle_rad) * signal[i] + std::cos(angle_rad) * signal[length + i]);
  }
  return loop;
}

void scale_to(double g_rms, std::span<float> track, const char* name) {
  const double now = rms(track);
  if (!(now > still))
    throw Error(ErrorKind::invalid_input,
                std::string(name) + " is still between 0.2 and 500 Hz; take a recording made while reaming");
  const double factor = g_rms / now;
  for (float& sample : track) sample = static_cast<float>(factor * static_cast<double>(sample));
}

using Files = std::array<std::filesystem::path, vibration_kinds>;

VibrationTrack synthesized_track(VibrationKind kind, uint64_t seed) {
  const double g_rms = vibration_levels[static_cast<size_t>(kind)].g_rms;
  return prepared_vibration(synthesized_vibration(kind, seed), g_rms, "the synthesized vibration");
}

VibrationTrack recorded_track(VibrationKind kind, const std::filesystem::path& file, double rate_hz) {
  VibrationRecording recording = read_vibration_recording(file, rate_hz);
  if (recording.rate_hz != vibration_raw_rate_hz) {
    const std::vector<float> raw(recording.samples.begin(), recording.samples.end());
    const std::vector<float> fitting = resampled(raw, recording.rate_hz, vibration_raw_rate_hz);
    recording.samples.assign(fitting.begin(), fitting.end());
  }
  const double g_rms = vibration_levels[static_cast<size_t>(kind)].g_rms;
  return prepared_vibration(std::move(recording.samples), g_rms, file.c_str());
}

/// Kinds side by side: making one takes a fifth of a second. A kind without a file is synthesized.
std::shared_ptr<const VibrationTracks> made(const Files& files, double rate_hz, uint64_t seed) {
  std::array<std::future<VibrationTrack>, vibration_kinds> parts;
  for (size_t k = 0; k < vibration_kinds; ++k)
    parts[k] = start_task([&files, rate_hz, seed, k] {
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
  static std::shared_ptr<const VibrationTracks> last;  // the next session is of the same seed as a rule
  const std::lock_guard lock(mutex);
  std::erase_if(living, [](const auto& entry) { return entry.second.expired(); });
  if (const auto found = living.find(seed); found != living.end())
    if (auto tracks = found->second.lock()) return tracks;
  auto tracks = made({}, 0.0, seed);
  living[seed] = last = tracks;
  return tracks;
}

Files files_of(const VibrationRecordings& recordings) {
  if (recordings.cortical.empty() || recordings.cancellous.empty())
    throw Error(ErrorKind::invalid_input,
                "vibration from recordings needs both cortical_file and cancellous_file");
  return {recordings.cancellous, recordings.cortical, {}, recordings.idle};
}

}  // namespace

std::vector<double> synthesized_vibration(VibrationKind kind, uint64_t seed) {
  const VibrationLevel& level = vibration_levels[static_cast<size_t>(kind)];
  Random random(hash_combine(seed, static_cast<uint64_t>(kind)));
  const Blow blow_of_one = blow(kind);
  const double blows_share = level.peak_to_peak_g > 0.0 ? share_of_blows : 0.0;
  // The track gets its g_rms back after 1 kHz has taken its part.
  const double power_g2 = level.g_rms * level.g_rms / blow_of_one.kept;

  // Even noise of +-w has variance w^2 / 3; the filter multiplies it by the energy of its response.
  const double noise = std::sqrt(3.0 * (1.0 - blows_share) * power_g2 / blow_of_one.energy);
  std::vector<double> signal(static_cast<size_t>((level.seconds + vibration_seam_s) * vibration_raw_rate_hz));
  for (double& sample : signal) sample = noise * (2.0 * random.even() - 1.0);

  if (blows_share > 0.0) {
    const double noise_g_rms = std::sqrt((1.0 - blows_share) * power_g2);
    const double strongest_g = (0.5 * level.peak_to_peak_g - reach_of_noise * noise_g_rms) / reach_of_blows;
    const double strongest = strongest_g / blow_of_one.peak;
    const double mean_square_part = (1.0 + weakest_blow + weakest_blow * weakest_blow) / 3.0;
    const double energy_of_a_blow = strongest * strongest * mean_square_part * blow_of_one.energy;
    add_blows(signal, strongest, energy_of_a_blow / (blows_share * power_g2), blow_of_one.delay, random);
  }
  colour(kind, signal);
  return signal;
}

double specimen_vibration(VibrationKind kind, uint64_t seed) {
  const VibrationLevel& level = vibration_levels[static_cast<size_t>(kind)];
  // Even numbers within +-1 have a deviation of 1 / sqrt(3); three of them together one of 1, and end at 3.
  Random random(hash_combine(hash_combine(seed, specimen_of_seed), static_cast<uint64_t>(kind)));
  double normal = 0.0;
  for (int i = 0; i < 3; ++i) normal += 2.0 * random.even() - 1.0;
  const double spread = level.g_rms_deviation / level.g_rms;
  return std::max(0.1, 1.0 + spread * normal);
}

double rms(std::span<const float> signal) {
  double sum = 0.0;
  for (const float sample : signal) sum += static_cast<double>(sample) * static_cast<double>(sample);
  return std::sqrt(sum / static_cast<double>(signal.size()));
}

VibrationTrack prepared_vibration(std::vector<double> signal, double g_rms, const char* name) {
  if (signal.size() < samples_in(min_vibration_s))
    throw Error(ErrorKind::invalid_input,
                std::string(name) + " is shorter than 2 s; take a longer recording");
  start_from_mean(signal);
  filter_in_place(butterworth_high_pass(vibration_high_pass_hz, vibration_raw_rate_hz), signal);
  filter_in_place(butterworth_low_pass(vibration_low_pass_hz, vibration_raw_rate_hz), signal);
  std::vector<float> loop = looped(signal);
  scale_to(1.0, loop, name);
  constexpr double tick_hz = 1.0 / tick_s;
  VibrationTrack track =
      resampled_loop(resampled_loop(loop, vibration_raw_rate_hz, tick_hz), tick_hz, vibration_track_rate_hz);
  scale_to(g_rms, track, name);
  return track;
}

const char* to_text(VibrationSource source) {
  switch (source) {
    case VibrationSource::off: return "off";
    case VibrationSource::synthesized: return "synthesized";
    case VibrationSource::recording: return "recording";
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
  for (const VibrationTrack& track : by_kind) rolling = hash_bytes(std::as_bytes(std::span(track)), rolling);
  return rolling;
}

std::shared_ptr<const VibrationTracks> make_vibration_tracks(const VibrationSettings& settings,
                                                             uint64_t seed) {
  switch (settings.source) {
    case VibrationSource::off: return nullptr;
    case VibrationSource::synthesized: return synthesized(seed);
    case VibrationSource::recording:
      return made(files_of(settings.recordings), settings.recordings.rate_hz, seed);
  }
  return nullptr;
}

}  // namespace ream::force
