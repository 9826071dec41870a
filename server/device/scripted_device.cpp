#include "device/scripted_device.hpp"

#include "core/clock.hpp"
#include "core/error.hpp"
#include "device/profiles.hpp"
#include "device/scripted_timeline.hpp"

namespace ream::device {

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
  input.paused = buttons.pause || session_paused_;
  if (!act(t_s, input)) return DeviceStatus::finished;
  if (!session_paused_) ++tick_;
  return DeviceStatus::ok;
}

std::unique_ptr<HapticDevice> make_scripted_device(const Script& script, const Pose& world_from_plan,
                                                   uint64_t random_seed) {
  switch (script.kind) {
    case ScriptKind::poses:
      return make_pose_device(script, world_from_plan);
    case ScriptKind::robot:
      return make_robot_device(script, world_from_plan);
    case ScriptKind::remote:
      throw Error(ErrorKind::invalid_input,
                  "this script plays nothing, it is for somebody with a device; name one, such as 'browser'");
    case ScriptKind::hand:
      break;
  }
  if (device_profile(script.device_profile).causality == Causality::admittance)
    return make_gripping_hand_device(script, world_from_plan, random_seed);
  return make_hand_device(script, world_from_plan, random_seed);
}

}  // namespace ream::device
