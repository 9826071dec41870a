#pragma once
#include <optional>

#include "force/coefficients.hpp"

namespace ream::force {

/// A reaming drive, seen from its chuck. Nobody published one for glenoid reamers, so all of these are
/// engineering choices: a cordless surgical drive of 6 N m in its reaming gear.
struct SpindleSettings {
  double stall_torque_n_mm = 6000.0;  ///< the most that the motor gives, at any speed
  double droop_rad_s_per_n_mm = 0.1 * reference_spindle_rad_s / 1000.0;  ///< 10 % of 156 rpm at 1 N m
  double inertia_kg_mm2 = 3600.0;         ///< of motor, gear and reamer, as the reamer feels it
  double start_s = 0.25, coast_s = 0.15;  ///< from rest to full speed, and back
  /// Torque that tears lips loose that stood pressed into bone, over what turns them at the same force: a
  /// blade that is buried in a femoral head takes 4.4 N m (SD 1.9; JOSR 2014 9:109) where this reamer would
  /// take 0.7.
  double catch_ratio = 6.5;
  double mass_kg = 1.2;  ///< of the drive with its reamer, which a slip accelerates
};

/// What holds the reamer back in a tick.
struct SpindleLoad {
  double torque_n_mm = 0.0;  ///< while it turns
  bool lips_bite = false;    ///< lips are pressed into bone, so that they catch once they stand
};

/// The reamer's speed. Without settings it is at once what is asked for, whatever the load: as in recordings
/// from before there was a drive. Only + - x /; no allocation, no exception.
class Spindle {
 public:
  explicit Spindle(const std::optional<SpindleSettings>& settings) : settings_(settings) {}

  /// One tick. `asked_rad_s`: by trigger and sense of rotation, negative in reverse; `full_rad_s`: of a
  /// trigger that is pressed all the way; `load`: of the tick before, which holds back whichever way it
  /// turns.
  void advance(double asked_rad_s, double full_rad_s, const SpindleLoad& load) noexcept;

  double speed_rad_s() const noexcept { return speed_rad_s_; }
  /// What the motor gives, and the hand holds against: positive when it drives forwards.
  double motor_torque_n_mm() const noexcept { return motor_n_mm_; }
  /// What the bone took of it: the motor's, less what sped the reamer up.
  double bone_torque_n_mm() const noexcept { return bone_n_mm_; }
  /// It has been asked to turn for stall_ticks and bone holds it.
  bool is_stalled() const noexcept { return held_ticks_ >= stall_ticks; }

  /// Between this and rest no surgeon would say that it turns, share of the full speed.
  static constexpr double standing_share = 0.02;
  /// Engineering choice; less than the 30 ms in which a hand notices a burst.
  static constexpr int stall_ticks = 20;

 private:
  void follow(double asked_rad_s, double full_rad_s) noexcept;
  double held_back_n_mm(const SpindleLoad& load) const noexcept;

  std::optional<SpindleSettings> settings_;
  double set_rad_s_ = 0.0;  ///< what the motor's controller aims at: follows what is asked
  double speed_rad_s_ = 0.0, motor_n_mm_ = 0.0, bone_n_mm_ = 0.0;
  double bite_ = 0.0;  ///< 0 to 1: how far the lips have sunk in
  int held_ticks_ = 0;
};

}  // namespace ream::force
