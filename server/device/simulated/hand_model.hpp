#pragma once
#include <array>
#include <cstdint>

#include "device/script/script.hpp"
#include "geometry/vec.hpp"

namespace ream::device {

/// Physiological tremor as a force, N: noise between 8 and 12 Hz, alike and independent in the three
/// directions. Random numbers are counted, not drawn: sample i depends on seed and i only. Arithmetic is
/// + - x and square roots, so a seed gives the same samples on every machine.
class Tremor {
 public:
  /// `rms_n`: root mean square of each component.
  Tremor(uint64_t seed, double rms_n);

  /// Starts the same sequence again. Runs the filter in, so that the first sample is like any other.
  void begin() noexcept;
  /// The next tick's force.
  Vec3 next() noexcept;

 private:
  /// Transposed direct form II of one second-order section with zeros at 0 Hz and the Nyquist frequency.
  struct Section {
    double s1 = 0.0, s2 = 0.0;
    double run(double x, double a1, double a2) noexcept;
  };
  static double filtered(std::array<Section, 2>& sections, double x) noexcept;

  uint64_t seed_;
  uint64_t counter_ = 0;
  double gain_;  ///< from noise in -1..1 to newtons
  std::array<std::array<Section, 2>, 3> sections_{};
};

/// What acts on something, simulated newtons, plan frame; torque about the handle's origin.
struct Load {
  Vec3 force_n = Vec3::Zero();
  Vec3 torque_n_mm = Vec3::Zero();
};

/// A hand as a body: a mass on a damped arm with a spring to where it began, pushed along the line it holds
/// and kept on it by a spring; where its wrist yields, a moment of inertia on a damped spring about the
/// orientation it holds. Semi-implicit Euler at one tick. Plan frame; simulated newtons throughout, so that
/// one script feels alike at any force scale.
class HandModel {
 public:
  HandModel(const HandParameters& hand, uint64_t random_seed);

  /// At rest where the script begins.
  void begin() noexcept;
  /// One tick under the force that the script means to push with and what the handle does to the hand.
  void advance(double target_n, const Load& felt) noexcept;
  /// From here on the hand keeps to another line, through `on_line_mm` along the z axis of `held`, and holds
  /// its handle so. Plan frame.
  void hold(const Vec3& on_line_mm, const Mat3& held) noexcept;
  /// A person who pauses rests the hand where it is.
  void rest() noexcept;

  Pose plan_from_hand() const noexcept;
  const Vec3& velocity_mm_s() const noexcept { return velocity_mm_s_; }
  /// Of the wrist against the orientation that the hand holds, hand frame, rad and rad/s.
  const Vec3& turn_rad() const noexcept { return turn_rad_; }
  const Vec3& turn_rate_rad_s() const noexcept { return turn_rate_rad_s_; }
  const Mat3& held_rotation() const noexcept { return held_; }

 private:
  static constexpr size_t max_reaction_ticks = 1000;

  double push_n(double target_n, double felt_n) noexcept;
  void turn(const Vec3& torque_n_mm) noexcept;

  HandParameters hand_;
  Tremor tremor_;
  Mat3 held_;
  Vec3 position_mm_, velocity_mm_s_ = Vec3::Zero();
  Vec3 turn_rad_ = Vec3::Zero(), turn_rate_rad_s_ = Vec3::Zero();
  std::array<double, max_reaction_ticks> felt_n_{};  ///< along the line, of the last ticks, a ring
  size_t reaction_ticks_, now_ = 0;
};

/// The same hand, holding a handle that goes its own way: between them the flesh of the grip, a spring and a
/// damper, whose force drives the handle and holds back the hand. The wrist acts on the handle without
/// inertia of its own.
class GrippingHand : public HandModel {
 public:
  GrippingHand(const HandParameters& hand, uint64_t random_seed);

  /// What the hand does to the handle, of which this is the place, the velocity and the turn rate (its own
  /// frame). Simulated newtons, plan frame.
  Load grip(const Pose& plan_from_handle, const Vec3& velocity_mm_s,
            const Vec3& turn_rate_rad_s) const noexcept;

 private:
  double stiffness_n_mm_, damping_n_s_mm_;
  Wrist wrist_;
};

}  // namespace ream::device
