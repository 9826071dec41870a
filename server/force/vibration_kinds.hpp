#pragma once
#include <array>
#include <cstddef>

namespace ream::force {

/// What makes the reamer vibrate. The first three are the bone classes in the order of EngagedBone.
enum class VibrationKind { cancellous, cortical, cartilage, idle };
inline constexpr size_t vibration_kinds = 4;

/// How strong one kind is, and how far single blows stand out of it.
struct VibrationLevel {
  double g_rms;           ///< over the whole track, g
  double peak_to_peak_g;  ///< in a window of five seconds, g; 0: nothing stands out
  double seconds;         ///< length of a synthesized track
};

/// Thesis table 5.2: means over the specimens, after the filters below, with g_rms +- 0.07 and 0.09 and
/// peak-to-peak +- 0.95 and 1.06. Its drill ran while it cut, so idle spin is part of both. What cartilage
/// and the idle drill do nobody published: both are engineering choices, quiet beside bone and without blows.
inline constexpr std::array<VibrationLevel, vibration_kinds> vibration_levels{
    {{0.40, 5.28, 60.0}, {0.30, 4.93, 60.0}, {0.10, 0.0, 20.0}, {0.05, 0.0, 20.0}}};

inline constexpr double vibration_sound_rate_hz =
    22050.0;                                            ///< of the experiments (thesis 5.3); kept for sound
inline constexpr double vibration_high_pass_hz = 0.2;   ///< takes gravity away (thesis 5.3)
inline constexpr double vibration_low_pass_hz = 500.0;  ///< ends what can be felt (thesis 5.3)

/// The shortest time that is a whole number of samples at 22,050 Hz and of ticks.
inline constexpr size_t sound_samples_a_beat = 441, ticks_a_beat = 20;

/// Depth of the modulation of amplitude as the lips pass, 13 times a second at 156 rpm. Engineering choice.
inline constexpr double lip_pass_depth = 0.2;
/// Time in which one kind of vibration gives way to another. Engineering choice, ticks.
inline constexpr int vibration_fade_ticks = 50;

}  // namespace ream::force
