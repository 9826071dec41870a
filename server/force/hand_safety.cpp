#include "force/hand_safety.hpp"

#include <algorithm>

#include "core/clock.hpp"
#include "core/units.hpp"

namespace ream::force {
namespace {

/// Most energy, mJ, that a force (or torque) of this size held for the coming tick can give a hand of that
/// speed and readiness to move.
double max_given_mj(double load, double speed, double speed_gain, double min_mass) {
  const double pushed = tick_s * mm_s2_per_n_kg * load / min_mass;
  return tick_s * load * (speed + speed_gain + pushed);
}

}  // namespace

double StartUpRamp::next(double desired_n) noexcept {
  if (gain_ >= 1.0) return gain_;
  if (small_seen_ < small_ticks && waited_++ < max_wait_ticks)
    small_seen_ = desired_n < small_force_n ? small_seen_ + 1 : 0;
  else
    gain_ = std::min(1.0, gain_ + tick_s / ramp_s_);
  return gain_;
}

void EnergyGuard::observe(const Pose& world_from_handle) noexcept {
  if (started_) {
    const Vec3 way_mm = world_from_handle.translation_mm - world_from_handle_.translation_mm;
    const Mat3& before = world_from_handle_.rotation;
    const Vec3 turn_rad = before * turn_between(before, world_from_handle.rotation);
    const double given_back_mj = rendered_.force_n.dot(way_mm) + rendered_.torque_n_mm.dot(turn_rad);
    energy_mj_ -= given_back_mj;
    saved_mj_ -= given_back_mj;
    speed_mm_s_ = std::max(way_mm.norm() / tick_s, speed_mm_s_ * energy_guard::speed_kept);
    speed_rad_s_ = std::max(turn_rad.norm() / tick_s, speed_rad_s_ * energy_guard::speed_kept);
  }
  started_ = true;
  world_from_handle_ = world_from_handle;
}

Wrench EnergyGuard::allow(const Wrench& desired, double stored_mj) noexcept {
  using namespace energy_guard;
  saved_mj_ = std::min(saved_mj_, stored_mj + max_saved_mj);
  const double max_given_back_mj =
      max_given_mj(desired.force_n.norm(), speed_mm_s_, speed_gain_mm_s, min_mass_kg) +
      max_given_mj(desired.torque_n_mm.norm(), speed_rad_s_, speed_gain_rad_s, min_inertia_kg_mm2);
  const double available_mj = std::max(0.0, saved_mj_ + credit_mj);
  rendered_ = desired;
  if (max_given_back_mj > available_mj) {
    rendered_ = desired.scaled(available_mj / max_given_back_mj);
    ++weakened_ticks_;
  }
  return rendered_;
}

}  // namespace ream::force
