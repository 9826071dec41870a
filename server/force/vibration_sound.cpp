#include "force/vibration_sound.hpp"

namespace ream::force {

VibrationSound::VibrationSound(std::shared_ptr<const VibrationTracks> tracks, uint64_t seed)
    : tracks_(std::move(tracks)) {
  if (!tracks_) return;
  at_ = start_beats(*tracks_, seed);
  for (size_t& at : at_) at *= sound_samples_a_beat;
}

void VibrationSound::render(std::span<const VibrationInput> ticks, std::vector<float>& sound_g) {
  for (const VibrationInput& tick : ticks) render(mix_.next(tick), sound_g);
}

void VibrationSound::render(const VibrationGains& gains, std::vector<float>& sound_g) {
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
