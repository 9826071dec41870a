#include "force/vibration/vibration_player.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock.hpp"
#include "core/hash.hpp"
#include "core/units.hpp"
#include "force/coefficients.hpp"

namespace ream::force {
namespace {

constexpr auto idle = static_cast<size_t>(VibrationKind::idle);

/// Sets the starts of tracks apart from what else comes from the seed.
constexpr uint64_t start_of_kind = 0x100;

constexpr size_t track_samples_a_tick = static_cast<size_t>(vibration_track_rate_hz * tick_s);

/// Of a loop, at a place within it.
double between_samples(const VibrationTrack& track, double at) noexcept {
  const auto low = static_cast<size_t>(at);
  const double from = static_cast<double>(track[low]);
  const double to = static_cast<double>(track[low + 1 < track.size() ? low + 1 : 0]);
  return from + (at - static_cast<double>(low)) * (to - from);
}

/// The mean of (1 + d cos)^2 is 1 + d^2 / 2.
const double lips_mean_square_kept = 1.0 / std::sqrt(1.0 + 0.5 * lip_pass_depth * lip_pass_depth);

std::array<double, vibration_kinds> target_levels(const VibrationInput& input) noexcept {
  std::array<double, vibration_kinds> desired{};
  if (!input.turning) return desired;
  desired[idle] = std::min(1.0, input.spindle_speed_rad_s / reference_spindle_rad_s);
  for (size_t k = 0; input.cutting && k < input.share.size(); ++k)
    desired[k] = input.strength[k] * std::sqrt(std::max(0.0, input.share[k]));
  return desired;
}

}  // namespace

double cut_strength(double thrust_n, double spindle_speed_rad_s, double edge_mm) noexcept {
  if (!(edge_mm > 0.0)) return 0.0;
  const double strength = std::max(0.0, thrust_n) / reference_thrust_n * spindle_speed_rad_s /
                          reference_spindle_rad_s *
                          std::sqrt(CuttingCoefficients{}.edge_reference_mm / edge_mm);
  return std::min(strength, max_cut_strength);
}

VibrationGains VibrationMix::next(const VibrationInput& input) noexcept {
  if (input.paused) return level_ = {};
  const double max_change = std::max({1.0, input.strength[0], input.strength[1], input.strength[2], level_[0],
                                      level_[1], level_[2]}) /
                            vibration_fade_ticks;
  const auto desired = target_levels(input);
  for (size_t k = 0; k < vibration_kinds; ++k)
    level_[k] += std::clamp(desired[k] - level_[k], -max_change, max_change);

  if (input.turning)
    lip_phase_rad_ = std::fmod(lip_phase_rad_ + lip_count * input.spindle_speed_rad_s * tick_s, 2.0 * pi);
  const double lips = lips_mean_square_kept * (1.0 + lip_pass_depth * std::cos(lip_phase_rad_));
  VibrationGains gains;
  for (size_t k = 0; k < vibration_kinds; ++k) gains[k] = k == idle ? level_[k] : lips * level_[k];
  return gains;
}

double track_speed(double spindle_speed_rad_s) noexcept {
  return std::min(1.0, std::abs(spindle_speed_rad_s) / reference_spindle_rad_s);
}

VibrationPlayer::VibrationPlayer(std::shared_ptr<const VibrationTracks> tracks, uint64_t seed)
    : tracks_(std::move(tracks)) {
  if (!tracks_) return;
  for (size_t k = 0; k < vibration_kinds; ++k) {
    const size_t ticks = tracks_->by_kind[k].size() / track_samples_a_tick;
    at_[k] = static_cast<double>(hash_combine(seed, start_of_kind + k) % ticks * track_samples_a_tick);
  }
}

double VibrationPlayer::next_g(const VibrationInput& input) noexcept {
  if (!tracks_) return 0.0;
  const VibrationGains gains = mix_.next(input);
  const double step = track_samples_a_tick * track_speed(input.spindle_speed_rad_s);
  double sum_g = 0.0;
  for (size_t k = 0; k < vibration_kinds; ++k) {
    const VibrationTrack& track = tracks_->by_kind[k];
    sum_g += gains[k] * between_samples(track, at_[k]);
    at_[k] += step;
    const auto length = static_cast<double>(track.size());
    if (at_[k] >= length) at_[k] -= length;
  }
  return sum_g;
}

}  // namespace ream::force
