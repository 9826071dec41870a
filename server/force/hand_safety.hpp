#pragma once
#include "force/wrench.hpp"
#include "geometry/pose.hpp"

namespace ream::force {

/// Keeps a hand from being met by a sudden force when rendering begins: nothing is rendered until the wanted
/// force has been small for a few ticks, then its gain rises evenly to one (practice of CHAI3D's
/// tools).
class StartUpRamp {
 public:
  static constexpr double small_force_n = 0.2;
  static constexpr int small_ticks = 4;
  /// A hand that begins pressed against something is met too, by the same ramp, after this long.
  static constexpr int max_wait_ticks = 1000;

  /// `ramp_s`: time from nothing to all; 0 renders everything at once.
  explicit StartUpRamp(double ramp_s = 0.0) : ramp_s_(ramp_s), gain_(ramp_s > 0.0 ? 0.0 : 1.0) {}

  /// From the start again: rendering has been interrupted (a pause).
  void restart() noexcept {
    small_seen_ = waited_ = 0;
    gain_ = ramp_s_ > 0.0 ? 0.0 : 1.0;
  }
  double gain() const { return gain_; }
  /// Gain of this tick, 0 to 1. `desired_n`: hand force that would be rendered.
  double next(double desired_n) noexcept;

 private:
  double ramp_s_;
  double gain_;
  int small_seen_ = 0, waited_ = 0;
};

/// Engineering choices of the guard; see EnergyGuard.
namespace energy_guard {
/// What the device may give beyond what the hand has put in, N mm = mJ. A millijoule is promised; the rest is
/// for rounding.
inline constexpr double credit_mj = 0.9;
/// What was put in earlier pays for later only up to this much over what the spring now holds: bone has used
/// up the rest.
inline constexpr double max_saved_mj = 20.0;
/// How fast a hand may gain speed by itself in a tick: 100 m/s^2 and 1000 rad/s^2.
inline constexpr double speed_gain_mm_s = 100.0, speed_gain_rad_s = 1.0;
/// What the device's own wrench moves is at least this much of hand and handle.
inline constexpr double min_mass_kg = 0.5, min_inertia_kg_mm2 = 1250.0;
/// A hand that was fast may be so again in the other direction: its speed is forgotten by this part a tick.
inline constexpr double speed_kept = 0.98;
}  // namespace energy_guard

/// Passivity observer and controller of the hand side. It counts the energy that the hand puts into the
/// simulation (exact for a force held over the tick: Hannaford & Ryu 2002) and weakens the next wrench, all
/// of it alike, so that even the farthest way the handle can go within the coming tick does not bring back
/// more than was put in plus a small credit. It never strengthens: so it neither pulls nor steps up. A real
/// spring's energy always suffices; what is cut off is only what sampling would have made up.
class EnergyGuard {
 public:
  /// Counts the tick that has passed: the handle is now at `world_from_handle`. Call once a tick.
  void observe(const Pose& world_from_handle) noexcept;
  /// `desired` (world frame, about the handle's origin), weakened as needed; remembered as what the device
  /// renders until the next observe(). `stored_mj` is what the coupling's spring holds.
  Wrench allow(const Wrench& desired, double stored_mj) noexcept;

  /// What the hand has put in and not got back since the start, mJ; never below -1 when the handle keeps
  /// within the assumed acceleration.
  double energy_mj() const { return energy_mj_; }
  /// Ticks in which a wrench was weakened.
  uint64_t weakened_ticks() const { return weakened_ticks_; }

 private:
  bool started_ = false;
  Pose world_from_handle_;
  Wrench rendered_;
  double energy_mj_ = 0.0, saved_mj_ = 0.0;
  double speed_mm_s_ = 0.0, speed_rad_s_ = 0.0;  ///< largest of late
  uint64_t weakened_ticks_ = 0;
};

}  // namespace ream::force
