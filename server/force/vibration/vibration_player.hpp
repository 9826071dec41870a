#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "force/vibration/vibration_tracks.hpp"

namespace ream::force {

/// What one tick says about vibration.
struct VibrationInput {
  bool spindle_on = false;
  double spindle_speed_rad_s = 0.0;
  bool cutting = false;           ///< the lips are in bone
  std::array<double, 3> share{};  ///< of the engaged cutting points: cancellous, cortical, cartilage
  bool paused = false;            ///< still at once; fades in again afterwards
};

/// How loud each kind is at one moment: factors of the tracks, lip-pass modulation included.
using VibrationGains = std::array<double, vibration_kinds>;

/// Fades between silence, idle spin and contact, and modulates contact as the lips pass. While cutting, each
/// class has the root of its share, so that the variances of the independent tracks add by share. The
/// modulation keeps the mean square.
class VibrationMix {
 public:
  /// Once a tick.
  VibrationGains next(const VibrationInput& input) noexcept;

 private:
  std::array<double, vibration_kinds> level_{};  ///< before modulation
  double lip_phase_rad_ = 0.0;
};

/// Where each track stands when tick 0 begins, in beats of 20 ticks: a different place for each seed.
std::array<size_t, vibration_kinds> start_beats(const VibrationTracks& tracks, uint64_t seed);

/// The acceleration of the reamer, tick after tick. Without tracks it is still. Nothing that decides depends
/// on it. No allocation, no lock, no exception.
class VibrationPlayer {
 public:
  VibrationPlayer() = default;
  VibrationPlayer(std::shared_ptr<const VibrationTracks> tracks, uint64_t seed);

  /// g in the tick that `input` describes; once a tick.
  double next_g(const VibrationInput& input) noexcept;

 private:
  std::shared_ptr<const VibrationTracks> tracks_;
  VibrationMix mix_;
  std::array<size_t, vibration_kinds> at_{};  ///< next sample of each track
};

}  // namespace ream::force
