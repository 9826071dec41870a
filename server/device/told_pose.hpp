#pragma once
#include "device/haptic_device.hpp"

namespace ream::device {

/// Where an admittance device stands and how fast it goes, from where it was told to go; plan frame.
class ToldPose {
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
