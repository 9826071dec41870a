#include <cmath>

#include "core/clock.hpp"
#include "device/scripted_timeline.hpp"

namespace ream::device {
namespace {

/// Common part: script time and buttons.
class ScriptedDevice : public HapticDevice {
 public:
  ScriptedDevice(const Script& script, const Pose& world_from_plan, std::string name)
      : script_(script), world_from_plan_(world_from_plan) {
    traits_.name = std::move(name);
    traits_.force_max_n = 1000.0;
    traits_.torque_max_n_mm = 100000.0;
    traits_.stiffness_max_n_mm = 100.0;
  }

  const DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override { tick_ = 0; }
  void close() noexcept override {}

  DeviceStatus read(DeviceInput& input) noexcept override {
    const double t_s = static_cast<double>(tick_) * tick_s;
    if (t_s >= script_.duration_s) return DeviceStatus::finished;
    const TimedButtons buttons = buttons_at(script_.buttons, t_s);
    input.spindle_on = buttons.spindle;
    input.paused = buttons.pause;
    input.world_from_handle = world_from_plan_ * plan_from_handle(t_s, buttons.pause);
    ++tick_;
    return DeviceStatus::ok;
  }

 protected:
  virtual Pose plan_from_handle(double t_s, bool paused) noexcept = 0;

  Script script_;
  Pose world_from_plan_;
  DeviceTraits traits_;
  int64_t tick_ = 0;
};

/// Follows timed poses whatever it feels.
class PoseDevice final : public ScriptedDevice {
 public:
  PoseDevice(const Script& script, const Pose& world_from_plan)
      : ScriptedDevice(script, world_from_plan, "poses") {}
  DeviceStatus write(const DeviceOutput&) noexcept override { return DeviceStatus::ok; }

 private:
  Pose plan_from_handle(double t_s, bool) noexcept override {
    const TimedPose pose = pose_at(script_.poses, t_s);
    return {rotation_from_small_vector(pose.rotation_vector_rad), pose.position_mm};
  }
};

/// A mass held by a damped arm, pushed along the line it holds and kept on it by a spring; semi-implicit
/// Euler.
class HandDevice final : public ScriptedDevice {
 public:
  HandDevice(const Script& script, const Pose& world_from_plan)
      : ScriptedDevice(script, world_from_plan, "hand"),
        rotation_(rotation_from_small_vector(script.hand.tilt_rad)),
        position_mm_(script.hand.start_mm) {}

  void open() override {
    ScriptedDevice::open();
    position_mm_ = script_.hand.start_mm;
    velocity_mm_s_.setZero();
    felt_n_.setZero();
  }

  DeviceStatus write(const DeviceOutput& output) noexcept override {
    felt_n_ = world_from_plan_.rotation.transpose() * output.force_n;
    return DeviceStatus::ok;
  }

 private:
  Pose plan_from_handle(double t_s, bool paused) noexcept override {
    if (paused) return hold();
    const HandParameters& hand = script_.hand;
    const Vec3 axis = rotation_.col(2);
    const Vec3 off_line = position_mm_ - hand.start_mm;
    const Vec3 sideways = off_line - axis * axis.dot(off_line);
    // The profile speaks in simulated newtons, and so do mass and springs: one script feels alike at any
    // force scale.
    const double push_n = force_at(hand.force_profile, t_s);
    const Vec3 force_n = axis * push_n - hand.guide_stiffness_n_mm * sideways + script_.force_scale * felt_n_;
    // 1 N on 1 kg is 1000 mm/s^2; damping is taken implicitly so that a light hand stays stable.
    constexpr double mm_s2_per_n_kg = 1000.0;
    const double gain = tick_s * mm_s2_per_n_kg / hand.mass_kg;
    velocity_mm_s_ = (velocity_mm_s_ + gain * force_n) / (1.0 + gain * hand.arm_damping_n_s_mm);
    position_mm_ += tick_s * velocity_mm_s_;
    return {rotation_, position_mm_};
  }

  /// A person who pauses rests the hand where it is.
  Pose hold() noexcept {
    velocity_mm_s_.setZero();
    return {rotation_, position_mm_};
  }

  Mat3 rotation_;
  Vec3 position_mm_, velocity_mm_s_ = Vec3::Zero(), felt_n_ = Vec3::Zero();
};

}  // namespace

std::unique_ptr<HapticDevice> make_scripted_device(const Script& script, const Pose& world_from_plan) {
  if (script.kind == ScriptKind::poses) return std::make_unique<PoseDevice>(script, world_from_plan);
  return std::make_unique<HandDevice>(script, world_from_plan);
}

}  // namespace ream::device
