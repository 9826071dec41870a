#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ream::force {

/// What makes the reamer vibrate. The first three are the bone classes in the order of EngagedBone.
enum class VibrationKind { cancellous, cortical, cartilage, idle };
inline constexpr size_t vibration_kinds = 4;

/// How strong one kind is, and how far single blows stand out of it.
struct VibrationLevel {
  double g_rms;            ///< over the whole track, g
  double g_rms_deviation;  ///< from specimen to specimen, g
  double peak_to_peak_g;   ///< in a window of five seconds, g; 0: nothing stands out
  double seconds;          ///< length of a synthesized track
};

/// Thesis table 5.2: means over the specimens, after the filters below, with g_rms +- 0.07 and 0.09 and
/// peak-to-peak +- 0.95 and 1.06. Its drill ran while it cut, so idle spin is part of both. What cartilage
/// and the idle drill do nobody published: both are engineering choices, quiet beside bone and without blows.
inline constexpr std::array<VibrationLevel, vibration_kinds> vibration_levels{
    {{0.40, 0.07, 5.28, 60.0}, {0.30, 0.09, 4.93, 60.0}, {0.10, 0.0, 0.0, 20.0}, {0.05, 0.0, 0.0, 20.0}}};

inline constexpr double vibration_raw_rate_hz = 22050.0;  ///< of the experiments (thesis 5.3)
inline constexpr double vibration_high_pass_hz = 0.2;     ///< takes gravity away (thesis 5.3)
inline constexpr double vibration_low_pass_hz = 500.0;    ///< ends what can be felt (thesis 5.3)

/// Of the prepared tracks: a player that reads between two samples loses next to nothing of what lies below
/// 500 Hz.
inline constexpr double vibration_track_rate_hz = 4000.0;

/// Depth of the modulation of amplitude as the lips pass, 13 times a second at 156 rpm. Engineering choice.
inline constexpr double lip_pass_depth = 0.2;
/// Time in which one kind of vibration gives way to another. Engineering choice, ticks.
inline constexpr int vibration_fade_ticks = 50;

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
  /// Hand newtons per g of the reamer: standard gravity times the mass of the handle, kg, that shall shake
  /// so.
  double vibration_n_per_g = 0.45;
  /// Limit of the vibration's own on the hand, beside that of the device, hand newtons.
  double vibration_max_n = 0.5;
};

/// Acceleration of the tool in g as a loop without a seam, at vibration_track_rate_hz and without what 1 kHz
/// cannot hold.
using VibrationTrack = std::vector<float>;

/// Time in which the end of a signal gives way to its beginning: the track is this much shorter. Seconds.
inline constexpr double vibration_seam_s = 0.5;
/// Shortest signal that can be prepared, s.
inline constexpr double min_vibration_s = 2.0;

/// The one way from a raw signal at 22,050 Hz, in any unit, to a track (thesis 5.3): Butterworth of order
/// four, high-pass 0.2 Hz and low-pass 500 Hz; end faded into beginning; resampled to 1 kHz and from there to
/// the tracks' rate; scaled to `g_rms`. Same input, same bits on one machine; it uses libm, and nothing that
/// decides depends on it. `signal` is used up. `name` tells people what it was. Errors: invalid_input when it
/// is shorter than min_vibration_s or still.
VibrationTrack prepared_vibration(std::vector<double> signal, double g_rms, const char* name);

/// Root of the mean square.
double rms(std::span<const float> signal);

/// The prepared tracks of a session, one a kind. They do not change.
struct VibrationTracks {
  std::array<VibrationTrack, vibration_kinds> by_kind;

  /// Of all samples; equal on one machine whenever source and seed are equal.
  uint64_t hash() const;
};

/// Reads or synthesizes, and prepares. Nothing (null) when the source is off. Sessions with the same seed
/// that live at the same time share what is synthesized; the last that was, 2.6 MB, stays for the next one.
/// Errors: those of read_vibration_recording and prepared_vibration; invalid_input when a file of a bone
/// class is not given.
std::shared_ptr<const VibrationTracks> make_vibration_tracks(const VibrationSettings& settings,
                                                             uint64_t seed);

/// How strongly this session's bone shakes the reamer, over the mean of all specimens: one draw a seed and
/// kind, with the deviation of table 5.2.
double specimen_vibration(VibrationKind kind, uint64_t seed);

/// Raw vibration of one kind at 22,050 Hz, to be prepared as a recording is. Noise and, for bone, blows of
/// bounded random size come through one colouring filter without a resonance: the spectrum rises up to the
/// material's corner (or the end of what a hand can feel) and has no line, and peak-to-peak is 13 to 16 times
/// g_rms where a Gaussian has 7 to 8. Same seed, same samples on one machine; other seeds are independent of
/// each other, and so are kinds.
std::vector<double> synthesized_vibration(VibrationKind kind, uint64_t seed);

}  // namespace ream::force
