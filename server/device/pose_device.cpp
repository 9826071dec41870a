#include "device/scripted_device.hpp"
#include "device/scripted_timeline.hpp"

namespace ream::device {
namespace {

/// Follows timed poses whatever it feels.
class PoseDevice final : public ScriptedDevice {
 public:
  PoseDevice(const Script& script, const Pose& world_from_plan)
      : ScriptedDevice(script, world_from_plan, "poses") {}
  DeviceStatus write(const DeviceOutput&) noexcept override { return DeviceStatus::ok; }

 private:
  void begin() noexcept override {}

  bool act(double t_s, DeviceInput& input) noexcept override {
    const TimedPose pose = pose_at(script_.poses, t_s);
    input.world_from_handle =
        world_from_plan_ * Pose{rotation_from_small_vector(pose.rotation_vector_rad), pose.position_mm};
    return true;
  }
};

}  // namespace

std::unique_ptr<HapticDevice> make_pose_device(const Script& script, const Pose& world_from_plan) {
  return std::make_unique<PoseDevice>(script, world_from_plan);
}

}  // namespace ream::device
