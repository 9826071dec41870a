#pragma once
#include "device/script.hpp"

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

std::unique_ptr<HapticDevice> make_pose_device(const Script& script, const Pose& world_from_plan);
/// Simulated hand on an impedance device: says where it is, feels a force.
std::unique_ptr<HapticDevice> make_hand_device(const Script& script, const Pose& world_from_plan,
                                               uint64_t random_seed);
/// Simulated hand on an admittance device: says how it pulls at the handle, is told where that is.
std::unique_ptr<HapticDevice> make_gripping_hand_device(const Script& script, const Pose& world_from_plan,
                                                        uint64_t random_seed);
/// Robot of the experiments (thesis 5.1).
std::unique_ptr<HapticDevice> make_robot_device(const Script& script, const Pose& world_from_plan);

}  // namespace ream::device
