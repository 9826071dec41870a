#include "device/simulated/scripted_device.hpp"

#include "core/clock.hpp"
#include "core/error.hpp"
#include "device/profiles.hpp"
#include "device/script/script.hpp"
#include "device/simulated/hand_model.hpp"

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

/// The same hand on an admittance device, which moves its handle. When neither moves, the device feels what
/// the script pushes with.
class GrippingHandDevice final : public ScriptedDevice {
 public:
  GrippingHandDevice(const Script& script, const Pose& world_from_plan, uint64_t random_seed)
      : ScriptedDevice(script, world_from_plan, "hand"), hand_(script.hand, random_seed) {}

  DeviceStatus write(const DeviceOutput& output) noexcept override {
    handle_.take(output, world_from_plan_.inverse());
    return DeviceStatus::ok;
  }

 private:
  void begin() noexcept override {
    hand_.begin();
    handle_.begin(hand_.plan_from_hand());
  }

  bool act(double t_s, DeviceInput& input) noexcept override {
    const Load on_handle =
        hand_.grip(handle_.plan_from_handle(), handle_.velocity_mm_s(), handle_.turn_rate_rad_s());
    if (input.paused)
      hand_.rest();
    else
      hand_.advance(force_at(script_.hand.force_profile, t_s), {-on_handle.force_n, -on_handle.torque_n_mm});
    const double per_simulated = 1.0 / script_.force_scale;
    input.world_from_handle = world_from_plan_ * handle_.plan_from_handle();
    input.hand_force_n = world_from_plan_.rotation * (per_simulated * on_handle.force_n);
    input.hand_torque_n_mm = world_from_plan_.rotation * (per_simulated * on_handle.torque_n_mm);
    return true;
  }

  GrippingHand hand_;
  CommandedPose handle_;
};

}  // namespace

void CommandedPose::begin(const Pose& plan_from_handle) noexcept {
  now_ = plan_from_handle;
  velocity_mm_s_.setZero();
  turn_rate_rad_s_.setZero();
}

void CommandedPose::take(const DeviceOutput& output, const Pose& plan_from_world) noexcept {
  const Pose next = output.world_from_tool ? plan_from_world * *output.world_from_tool : now_;
  velocity_mm_s_ = (next.translation_mm - now_.translation_mm) / tick_s;
  turn_rate_rad_s_ = turn_between(now_.rotation, next.rotation) / tick_s;
  now_ = next;
}

Vec3 CommandedPose::turn_rad(const Mat3& held) const noexcept { return turn_between(held, now_.rotation); }

ScriptedDevice::ScriptedDevice(const Script& script, const Pose& world_from_plan, const char* name)
    : script_(script), world_from_plan_(world_from_plan), traits_(device_profile(script.device_profile)) {
  traits_.name = name;
  traits_.simulated = true;
}

void ScriptedDevice::open() {
  tick_ = 0;
  session_paused_ = false;
  begin();
}

DeviceStatus ScriptedDevice::read(DeviceInput& input) noexcept {
  const double t_s = static_cast<double>(tick_) * tick_s;
  if (t_s >= script_.duration_s) return DeviceStatus::finished;
  const TimedButtons buttons = buttons_at(script_.buttons, t_s);
  input.spindle_on = buttons.spindle;
  input.drive = buttons.drive;
  input.paused = buttons.pause || session_paused_;
  if (!act(t_s, input)) return DeviceStatus::finished;
  if (!session_paused_) ++tick_;
  return DeviceStatus::ok;
}

std::unique_ptr<HapticDevice> make_scripted_device(const Script& script, const Pose& world_from_plan,
                                                   uint64_t random_seed) {
  switch (script.kind) {
    case ScriptKind::poses: return std::make_unique<PoseDevice>(script, world_from_plan);
    case ScriptKind::robot: return make_robot_device(script, world_from_plan);
    case ScriptKind::remote:
      throw Error(ErrorKind::invalid_input,
                  "this script plays nothing, it is for somebody with a device; name one, such as 'browser'");
    case ScriptKind::hand: break;
  }
  if (device_profile(script.device_profile).causality == Causality::admittance)
    return std::make_unique<GrippingHandDevice>(script, world_from_plan, random_seed);
  return std::make_unique<HandDevice>(script, world_from_plan, random_seed);
}

}  // namespace ream::device
