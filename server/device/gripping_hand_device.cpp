#include "device/hand_model.hpp"
#include "device/scripted_device.hpp"
#include "device/scripted_timeline.hpp"
#include "device/told_pose.hpp"

namespace ream::device {
namespace {

/// Of a wrist that the script calls rigid: an admittance device turns where it is told, so it must give.
/// Stiff enough that 1 N m turns it by one degree. Engineering choice.
constexpr Wrist firm_wrist{5.0e4, 500.0, 1.0e4};

/// The same hand as on an impedance device, holding a handle that goes its own way: between them the flesh of
/// the grip, a spring and a damper, whose force drives the handle and holds back the hand. When neither
/// moves, the device feels what the script pushes with. The wrist acts on the handle without inertia of its
/// own.
class GrippingHandDevice final : public ScriptedDevice {
 public:
  GrippingHandDevice(const Script& script, const Pose& world_from_plan, uint64_t random_seed)
      : ScriptedDevice(script, world_from_plan, "hand"),
        hand_(bodyless_wrist(script.hand), random_seed),
        wrist_(script.hand.wrist.value_or(firm_wrist)) {}

  DeviceStatus write(const DeviceOutput& output) noexcept override {
    handle_.take(output, world_from_plan_.inverse());
    return DeviceStatus::ok;
  }

 private:
  static HandParameters bodyless_wrist(HandParameters hand) {
    hand.wrist.reset();
    return hand;
  }

  void begin() noexcept override {
    hand_.begin();
    handle_.begin(hand_.plan_from_hand());
  }

  /// What the hand does to the handle, simulated newtons, plan frame.
  Load grip() const noexcept {
    const Vec3 stretch_mm = hand_.plan_from_hand().translation_mm - handle_.plan_from_handle().translation_mm;
    const Vec3 slip_mm_s = hand_.velocity_mm_s() - handle_.velocity_mm_s();
    const Mat3& held = hand_.held_rotation();
    return {script_.hand.grip_stiffness_n_mm * stretch_mm + script_.hand.grip_damping_n_s_mm * slip_mm_s,
            held * (-wrist_.stiffness_n_mm_rad * handle_.turn_rad(held) -
                    wrist_.damping_n_mm_s_rad * handle_.turn_rate_rad_s())};
  }

  bool act(double t_s, DeviceInput& input) noexcept override {
    const Load on_handle = grip();
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

  HandModel hand_;
  Wrist wrist_;
  ToldPose handle_;
};

}  // namespace

std::unique_ptr<HapticDevice> make_gripping_hand_device(const Script& script, const Pose& world_from_plan,
                                                        uint64_t random_seed) {
  return std::make_unique<GrippingHandDevice>(script, world_from_plan, random_seed);
}

}  // namespace ream::device
