#pragma once
#include <array>
#include <cstdint>

#include "device/script.hpp"
#include "device/tremor.hpp"

namespace ream::device {

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
  static constexpr size_t longest_reaction_ticks = 1000;

  double push_n(double target_n, double felt_n) noexcept;
  void turn(const Vec3& torque_n_mm) noexcept;

  HandParameters hand_;
  Tremor tremor_;
  Mat3 held_;
  Vec3 position_mm_, velocity_mm_s_ = Vec3::Zero();
  Vec3 turn_rad_ = Vec3::Zero(), turn_rate_rad_s_ = Vec3::Zero();
  std::array<double, longest_reaction_ticks> felt_n_{};  ///< along the line, of the last ticks, a ring
  size_t reaction_ticks_, now_ = 0;
};

}  // namespace ream::device
