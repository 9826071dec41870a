#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "force/vibration_player.hpp"

namespace ream::force {

/// What a VibrationPlayer with the same tracks and seed lets the hand feel, as sound of 22,050 Hz. Give it
/// every tick once and in order; it is for the thread that follows the loop, not for the loop.
class VibrationSound {
 public:
  VibrationSound() = default;
  VibrationSound(std::shared_ptr<const VibrationTracks> tracks, uint64_t seed);

  /// Appends the samples, in g, that these ticks bring: 441 for every 20 ticks. The sound of a tick ends at
  /// the moment of the tick, where it has the gains that the hand had; before, they run straight up to them.
  void render(std::span<const VibrationInput> ticks, std::vector<float>& sound_g);

 private:
  void render(const VibrationGains& gains, std::vector<float>& sound_g);

  std::shared_ptr<const VibrationTracks> tracks_;
  VibrationMix mix_;
  VibrationGains before_{};
  std::array<size_t, vibration_kinds> at_{};
  uint64_t tick_ = 0, sample_ = 0;  ///< next ones
};

}  // namespace ream::force
