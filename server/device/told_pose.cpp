#include "device/told_pose.hpp"

#include "core/clock.hpp"

namespace ream::device {

void ToldPose::begin(const Pose& plan_from_handle) noexcept {
  now_ = plan_from_handle;
  velocity_mm_s_.setZero();
  turn_rate_rad_s_.setZero();
}

void ToldPose::take(const DeviceOutput& output, const Pose& plan_from_world) noexcept {
  const Pose next = output.world_from_tool ? plan_from_world * *output.world_from_tool : now_;
  velocity_mm_s_ = (next.translation_mm - now_.translation_mm) / tick_s;
  turn_rate_rad_s_ = turn_between(now_.rotation, next.rotation) / tick_s;
  now_ = next;
}

Vec3 ToldPose::turn_rad(const Mat3& held) const noexcept { return turn_between(held, now_.rotation); }

}  // namespace ream::device
