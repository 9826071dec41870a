#pragma once
#include <memory>

#include "device/admittance/admittance_machine.hpp"

namespace ream::device {

/// A machine that senses force and moves, made a haptic device, with what makes it safe:
/// - open() zeroes the sensor while nobody pulls, then switches the motors on where the machine stands. Set
///   points begin where it holds then; a machine that has moved meanwhile is refused.
/// - Every set point keeps to the machine's speed, acceleration and reach. Where they hold it back, the
///   simulated mass feels that as a spring, so that tool and machine stay together.
/// - What the sensor says counts for nothing while it is no number, clipped or too old; from fade_ms of that
///   on the motion is braked to rest and stays there. It goes on from where it stands as soon as the sensor
///   speaks again, as after a pause: it never jumps.
/// - A machine that does not follow, whatever its sensor says, is stopped and told no more set points; that,
///   or one that cannot be told any more, is a fault: the session ends.
/// - close() brakes to rest, switches the motors off and then disconnects, in this order.
/// Such a machine pushes only by moving: at rest its hand meets a thing that stands still, and no more.
class AdmittanceDevice final : public HapticDevice {
 public:
  /// `world_from_start`: where the tool is at first; the handle's frame is the tool's there.
  AdmittanceDevice(std::unique_ptr<AdmittanceMachine> machine, const Pose& world_from_start);
  ~AdmittanceDevice() override;

  const DeviceTraits& traits() const noexcept override { return machine_->traits(); }
  /// Errors: those of the machine; unavailable in words when the sensor cannot be zeroed, or when it says
  /// nothing good or another place once the motors are on.
  void open() override;
  void close() noexcept override;
  void session_paused(bool paused) noexcept override;
  DeviceStatus read(DeviceInput& input) noexcept override;
  DeviceStatus write(const DeviceOutput& output) noexcept override;
  void take_force_away() noexcept override { machine_->stop(); }
  double closing_ms() const noexcept override;
  /// Machines are told where to be in the haptic thread itself.
  void use_priority(int) noexcept override {}

  /// Of the sensor's range: from here on a force is taken for clipped.
  static constexpr double clipped_share = 0.98;
  static constexpr int zeroing_samples = 200;
  /// A sensor that moves more than this while it is zeroed is being pulled at.
  static constexpr double zeroing_spread_n = 2.0;
  /// By which a machine may move while its motors go on. Engineering choices.
  static constexpr double enabling_moves_max_mm = 2.0, enabling_turns_max_rad = 0.05;
  /// What a driver has for stop(), disable() and close(). Engineering choice.
  static constexpr double release_ms = 250.0;

 private:
  void zero_sensor();
  void require_still();
  bool has_strayed(const MachineSense& sense) const noexcept;
  void halt() noexcept;
  bool is_good(const MachineSense& sense) const noexcept;
  Vec3 following_force_n() const noexcept;
  double braking_ms() const noexcept;
  void brake_to_rest() noexcept;
  void pace() const;

  const std::unique_ptr<AdmittanceMachine> machine_;
  const Pose world_from_start_;
  Pose world_from_base_, base_from_world_;
  MotionLimiter limiter_;
  MachineSense last_sense_;  ///< its last good word
  Vec3 zero_n_ = Vec3::Zero(), zero_n_mm_ = Vec3::Zero();
  Vec3 offset_mm_ = Vec3::Zero();  ///< base frame: of the set points against the tool
  Vec3 tool_mm_ = Vec3::Zero(), tool_velocity_mm_s_ = Vec3::Zero();  ///< base frame, with the offset
  double silent_ms_ = 0.0;
  bool opened_ = false, enabled_ = false, rests_ = true, session_paused_ = false;
  bool halted_ = false;  ///< by its own stop
};

}  // namespace ream::device
