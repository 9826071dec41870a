#pragma once
#include <memory>
#include "device/haptic_device.hpp"

#include "device/script/script.hpp"

namespace ream::device {

/// What every scripted device shares: script time, buttons, traits of its profile, and the plan frame.
class ScriptedDevice : public HapticDevice {
 public:
  ScriptedDevice(const Script& script, const Pose& world_from_plan, const char* name);

  const DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override;
  void close() noexcept override {}
  void session_paused(bool paused) noexcept override { session_paused_ = paused; }
  DeviceStatus read(DeviceInput& input) noexcept override;
  // Nobody's hand is in it, and it has no thread.
  void take_force_away() noexcept override {}
  double closing_ms() const noexcept override { return 0.0; }
  void use_priority(int) noexcept override {}

 protected:
  /// Puts itself at its beginning.
  virtual void begin() noexcept = 0;
  /// Fills pose or force of the tick at `t_s`, which stands still while the session is paused; false when the
  /// device has done what it had to.
  virtual bool act(double t_s, DeviceInput& input) noexcept = 0;

  Script script_;
  Pose world_from_plan_;
  DeviceTraits traits_;

 private:
  int64_t tick_ = 0;
  bool session_paused_ = false;
};

/// Robot of the experiments (thesis 5.1).
std::unique_ptr<HapticDevice> make_robot_device(const Script& script, const Pose& world_from_plan);

/// A device that plays `script`; `world_from_plan` puts it on a case. Time advances one tick a read. Throws
/// Error invalid_input for an unknown device profile, for a robot on an impedance device, and for a remote
/// script.
std::unique_ptr<HapticDevice> make_scripted_device(const Script& script, const Pose& world_from_plan,
                                                   uint64_t random_seed = 1);

/// Where an admittance device stands and how fast it goes, from where it was told to go; plan frame.
class CommandedPose {
 public:
  void begin(const Pose& plan_from_handle) noexcept;
  /// Takes the place of one tick later; an empty one: the device stays.
  void take(const DeviceOutput& output, const Pose& plan_from_world) noexcept;

  const Pose& plan_from_handle() const noexcept { return now_; }
  const Vec3& velocity_mm_s() const noexcept { return velocity_mm_s_; }
  /// Rotation against `held`, in its frame, rad.
  Vec3 turn_rad(const Mat3& held) const noexcept;
  /// In its own frame, rad/s.
  const Vec3& turn_rate_rad_s() const noexcept { return turn_rate_rad_s_; }

 private:
  Pose now_;
  Vec3 velocity_mm_s_ = Vec3::Zero(), turn_rate_rad_s_ = Vec3::Zero();
};

}  // namespace ream::device
