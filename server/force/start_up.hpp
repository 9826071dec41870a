#pragma once

namespace ream::force {

/// Keeps a hand from being met by a sudden force when rendering begins: nothing is rendered until the wanted
/// force has been small for a few ticks, then its gain rises evenly to one (practice of CHAI3D's tools,
/// science.md 1.3).
class StartUpRamp {
 public:
  static constexpr double small_force_n = 0.2;
  static constexpr int small_ticks = 4;
  /// A hand that begins pressed against something is met too, by the same ramp, after this long.
  static constexpr int longest_wait_ticks = 1000;

  /// `ramp_s`: time from nothing to all; 0 renders everything at once.
  explicit StartUpRamp(double ramp_s = 0.0) : ramp_s_(ramp_s), gain_(ramp_s > 0.0 ? 0.0 : 1.0) {}

  /// From the start again: rendering has been interrupted (a pause).
  void restart() noexcept {
    small_seen_ = waited_ = 0;
    gain_ = ramp_s_ > 0.0 ? 0.0 : 1.0;
  }
  double gain() const { return gain_; }
  /// Gain of this tick, 0 to 1. `wanted_n`: hand force that would be rendered.
  double next(double wanted_n) noexcept;

 private:
  double ramp_s_;
  double gain_;
  int small_seen_ = 0, waited_ = 0;
};

}  // namespace ream::force
