#include "device/hand_model.hpp"

#include <algorithm>

#include "core/clock.hpp"

namespace ream::device {
namespace {

constexpr double mm_s2_per_n_kg = 1000.0;          ///< 1 N on 1 kg
constexpr double rad_s2_per_n_mm_kg_mm2 = 1000.0;  ///< 1 N mm on 1 kg mm^2

size_t ticks_of(double time_s, size_t longest) {
  return std::clamp(static_cast<size_t>(time_s / tick_s + 0.5), size_t{1}, longest);
}

}  // namespace

HandModel::HandModel(const HandParameters& hand, uint64_t random_seed)
    : hand_(hand),
      tremor_(random_seed, hand.tremor_rms_n),
      held_(rotation_from_small_vector(hand.tilt_rad)),
      position_mm_(hand.start_mm),
      reaction_ticks_(ticks_of(hand.reaction_time_s, longest_reaction_ticks)) {}

void HandModel::begin() noexcept {
  tremor_.begin();
  position_mm_ = hand_.start_mm;
  felt_n_.fill(0.0);
  turn_rad_.setZero();
  rest();
}

void HandModel::hold(const Vec3& on_line_mm, const Mat3& held) noexcept {
  hand_.start_mm = on_line_mm;
  held_ = held;
}

void HandModel::rest() noexcept {
  velocity_mm_s_.setZero();
  turn_rate_rad_s_.setZero();
}

Pose HandModel::plan_from_hand() const noexcept {
  if (!hand_.wrist) return {held_, position_mm_};
  return {held_ * rotation_from_small_vector(turn_rad_), position_mm_};
}

double HandModel::push_n(double target_n, double felt_n) noexcept {
  // The ring's oldest entry is overwritten by the newest after it has been used.
  double& entry = felt_n_[now_];
  const double felt_then_n = entry;
  entry = felt_n;
  now_ = now_ + 1 < reaction_ticks_ ? now_ + 1 : 0;
  // A hand in the air has nothing to correct.
  const bool corrects = target_n > 0.0 && felt_then_n > 0.0;
  return corrects ? target_n + hand_.correction_gain * (target_n - felt_then_n) : target_n;
}

void HandModel::turn(const Vec3& torque_n_mm) noexcept {
  const Wrist& wrist = *hand_.wrist;
  const double gain = tick_s * rad_s2_per_n_mm_kg_mm2 / wrist.inertia_kg_mm2;
  // Spring and damper implicitly: stable however light the hand and stiff the wrist.
  const double held_back = gain * (wrist.damping_n_mm_s_rad + tick_s * wrist.stiffness_n_mm_rad);
  const Vec3 drive = held_.transpose() * torque_n_mm - wrist.stiffness_n_mm_rad * turn_rad_;
  turn_rate_rad_s_ = (turn_rate_rad_s_ + gain * drive) / (1.0 + held_back);
  turn_rad_ += tick_s * turn_rate_rad_s_;
}

void HandModel::advance(double target_n, const Load& felt) noexcept {
  const Vec3 axis = held_.col(2);
  const Vec3 off_line = position_mm_ - hand_.start_mm;
  const double along_mm = axis.dot(off_line);
  const Vec3 sideways = off_line - axis * along_mm;
  const double pushed_n = push_n(target_n, -axis.dot(felt.force_n));
  const Vec3 force_n = axis * pushed_n - hand_.guide_stiffness_n_mm * sideways + felt.force_n -
                       hand_.arm_stiffness_n_mm * along_mm * axis + tremor_.next();
  // Damping is taken implicitly so that a light hand stays stable.
  const double gain = tick_s * mm_s2_per_n_kg / hand_.mass_kg;
  velocity_mm_s_ = (velocity_mm_s_ + gain * force_n) / (1.0 + gain * hand_.arm_damping_n_s_mm);
  position_mm_ += tick_s * velocity_mm_s_;
  if (hand_.wrist) turn(felt.torque_n_mm);
}

}  // namespace ream::device
