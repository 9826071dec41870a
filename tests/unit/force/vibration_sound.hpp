#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "force/vibration/vibration_player.hpp"

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

inline VibrationSound::VibrationSound(std::shared_ptr<const VibrationTracks> tracks, uint64_t seed)
    : tracks_(std::move(tracks)) {
  if (!tracks_) return;
  at_ = start_beats(*tracks_, seed);
  for (size_t& at : at_) at *= sound_samples_a_beat;
}

inline void VibrationSound::render(std::span<const VibrationInput> ticks, std::vector<float>& sound_g) {
  for (const VibrationInput& tick : ticks) render(mix_.next(tick), sound_g);
}

inline void VibrationSound::render(const VibrationGains& gains, std::vector<float>& sound_g) {
  // Sample s falls on tick s * 20 / 441; this tick brings those that are not later than it.
  for (; sample_ * ticks_a_beat <= tick_ * sound_samples_a_beat; ++sample_) {
    const double to_go = static_cast<double>(tick_ * sound_samples_a_beat - sample_ * ticks_a_beat) /
                         static_cast<double>(sound_samples_a_beat);
    double sum_g = 0.0;
    for (size_t k = 0; k < vibration_kinds && tracks_; ++k) {
      const std::vector<float>& track = tracks_->by_kind[k].sound_g;
      sum_g += (gains[k] + to_go * (before_[k] - gains[k])) * static_cast<double>(track[at_[k]]);
      at_[k] = at_[k] + 1 < track.size() ? at_[k] + 1 : 0;
    }
    sound_g.push_back(static_cast<float>(sum_g));
  }
  before_ = gains;
  ++tick_;
}

}  // namespace ream::force
