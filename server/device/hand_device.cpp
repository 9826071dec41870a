#include "device/hand_model.hpp"
#include "device/scripted_device.hpp"
#include "device/scripted_timeline.hpp"

namespace ream::device {
namespace {

/// The hand's own place is the handle's; what the device renders acts on it.
class HandDevice final : public ScriptedDevice {
 public:
  HandDevice(const Script& script, const Pose& world_from_plan, uint64_t random_seed)
      : ScriptedDevice(script, world_from_plan, "hand"), hand_(script.hand, random_seed) {}

  /// Vibration is made in hand newtons and is too quick for a hand to give way to.
  DeviceStatus write(const DeviceOutput& output) noexcept override {
    const Mat3 plan_from_world = world_from_plan_.rotation.transpose();
    felt_.force_n = script_.force_scale * (plan_from_world * (output.force_n - output.vibration_n));
    felt_.torque_n_mm = script_.force_scale * (plan_from_world * output.torque_n_mm);
    return DeviceStatus::ok;
  }

 private:
  void begin() noexcept override {
    hand_.begin();
    felt_ = {};
  }

  bool act(double t_s, DeviceInput& input) noexcept override {
    if (input.paused)
      hand_.rest();
    else
      hand_.advance(force_at(script_.hand.force_profile, t_s), felt_);
    input.world_from_handle = world_from_plan_ * hand_.plan_from_hand();
    return true;
  }

  HandModel hand_;
  Load felt_;
};

}  // namespace

std::unique_ptr<HapticDevice> make_hand_device(const Script& script, const Pose& world_from_plan,
                                               uint64_t random_seed) {
  return std::make_unique<HandDevice>(script, world_from_plan, random_seed);
}

}  // namespace ream::device
