#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "force/vibration/vibration_tracks.hpp"

namespace ream::force {

/// What one tick says about vibration.
struct VibrationInput {
  bool turning = false;
  double spindle_speed_rad_s = 0.0;
  bool cutting = false;           ///< the lips are in bone
  std::array<double, 3> share{};  ///< of the engaged cutting points: cancellous, cortical, cartilage
  std::array<double, 3> strength{1.0, 1.0, 1.0};  ///< in each, over what was published
  bool paused = false;                            ///< still at once; fades in again afterwards
};

/// How much stronger than in the thesis' experiments a cut shakes the reamer: chips break one by one along
/// the edge, each with its load and unlike its neighbours, so amplitude rises with thrust and speed and falls
/// with the root of the edge that shares the thrust (exponents of 1: engineering choice).
/// Within 0 and max_cut_strength.
double cut_strength(double thrust_n, double spindle_speed_rad_s, double edge_mm) noexcept;
inline constexpr double max_cut_strength = 3.0;

/// How loud each kind is at one moment: factors of the tracks, lip-pass modulation included.
using VibrationGains = std::array<double, vibration_kinds>;

/// Fades between silence, idle spin and contact, and modulates contact as the lips pass. Idle spin goes on
/// under the cut, and each class has the root of its share, so that the variances of the independent tracks
/// add. The modulation keeps the mean square.
class VibrationMix {
 public:
  /// Once a tick.
  VibrationGains next(const VibrationInput& input) noexcept;

 private:
  std::array<double, vibration_kinds> level_{};  ///< before modulation
  double lip_phase_rad_ = 0.0;
};

/// How fast tracks run, over how they were made: chips follow each other as fast as the lips move, so the
/// spectrum moves with the spindle. Nothing is known of the experiments above 500 Hz, so a track that runs
/// slower ends lower, and above the experiments' speed none runs faster.
double track_speed(double spindle_speed_rad_s) noexcept;

/// The acceleration of the reamer, tick after tick. Each seed starts at places of its own in the tracks;
/// without tracks it is still. Nothing that decides depends on it. No allocation, no lock, no exception.
class VibrationPlayer {
 public:
  VibrationPlayer() = default;
  VibrationPlayer(std::shared_ptr<const VibrationTracks> tracks, uint64_t seed);

  /// g in the tick that `input` describes; once a tick.
  double next_g(const VibrationInput& input) noexcept;

 private:
  std::shared_ptr<const VibrationTracks> tracks_;
  VibrationMix mix_;
  std::array<double, vibration_kinds> at_{};  ///< next place in each track, samples
};

}  // namespace ream::force
