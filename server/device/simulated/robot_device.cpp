#include <algorithm>
#include <cmath>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "device/admittance/admittance_machine.hpp"
#include "device/simulated/scripted_device.hpp"

namespace ream::device {
namespace {

/// Time constant of the robot's speed control, and how long it may be held up before that is contact.
constexpr double speed_control_s = 0.004, contact_after_s = 0.02, under_way_after_s = 0.1;
/// How firmly the robot keeps its orientation, and how its line's spring is damped: at any stiffness the same
/// share of critical. Engineering choice.
constexpr double line_damping_n_s_mm = 0.2, damped_stiffness_n_mm = 20.0;
constexpr double turn_stiffness_n_mm_rad = 5.0e4, turn_damping_n_mm_s_rad = 500.0;

/// The experiments' robot (thesis 5.1) as an admittance device: it drives along its line until something
/// holds it up, then presses with a force that rises linearly and stays, and when the tool has advanced far
/// enough from there it withdraws to where it began.
class RobotDevice final : public ScriptedDevice {
 public:
  RobotDevice(const Script& script, const Pose& world_from_plan)
      : ScriptedDevice(script, world_from_plan, "robot"),
        robot_(script.robot),
        held_(rotation_from_small_vector(script.robot.tilt_rad)),
        line_damping_n_s_mm_(line_damping_n_s_mm *
                             std::sqrt(script.robot.line_stiffness_n_mm / damped_stiffness_n_mm)) {
    if (traits_.causality != Causality::admittance)
      throw Error(ErrorKind::invalid_input,
                  "a robot needs an admittance device, and " + traits_.profile + " is none");
  }

  DeviceStatus write(const DeviceOutput& output) noexcept override {
    handle_.take(output, world_from_plan_.inverse());
    return DeviceStatus::ok;
  }

 private:
  enum class Phase { approach, press, withdraw };

  void begin() noexcept override {
    last_s_ = 0.0;
    handle_.begin({held_, robot_.start_mm});
    from_mm_ = 0.0;
    enter(Phase::approach, 0.0);
  }

  void enter(Phase phase, double t_s) noexcept {
    phase_ = phase;
    since_s_ = t_s;
    moved_s_ = t_s;
  }

  /// A pause stops the robot's clock too; a pause of the session, the script's as well.
  void wait(double t_s) noexcept {
    since_s_ += t_s - last_s_;
    moved_s_ += t_s - last_s_;
  }

  double along_mm() const noexcept {
    return held_.col(2).dot(handle_.plan_from_handle().translation_mm - robot_.start_mm);
  }

  /// Along the line, simulated newtons.
  double drive_n(double speed_mm_s) const noexcept {
    const double mass_kg = traits_.effective_mass_kg * script_.force_scale;
    const double missing_mm_s = speed_mm_s - held_.col(2).dot(handle_.velocity_mm_s());
    return n_per_kg_mm_s2 * mass_kg / speed_control_s * missing_mm_s;
  }

  bool held_up(double t_s) noexcept {
    if (held_.col(2).dot(handle_.velocity_mm_s()) > 0.5 * robot_.approach_mm_s) {
      moved_s_ = t_s;
      from_mm_ = along_mm();
    }
    return t_s - since_s_ > under_way_after_s && t_s - moved_s_ > contact_after_s;
  }

  double axial_n(double t_s) noexcept {
    if (phase_ == Phase::approach && held_up(t_s)) enter(Phase::press, t_s);
    if (phase_ == Phase::press && along_mm() - from_mm_ >= robot_.depth_mm) enter(Phase::withdraw, t_s);
    if (phase_ == Phase::approach) return drive_n(robot_.approach_mm_s);
    if (phase_ == Phase::withdraw) return drive_n(-robot_.approach_mm_s);
    return robot_.force_n * std::min(1.0, (t_s - since_s_) / robot_.ramp_s);
  }

  bool act(double t_s, DeviceInput& input) noexcept override {
    if (input.paused) wait(t_s);
    last_s_ = t_s;
    const double axial = input.paused ? 0.0 : axial_n(t_s);
    if (phase_ == Phase::withdraw && along_mm() <= 0.0) return false;
    const Vec3 axis = held_.col(2);
    const Vec3 off_line = handle_.plan_from_handle().translation_mm - robot_.start_mm;
    const Vec3 sideways = off_line - axis * axis.dot(off_line);
    const Vec3 slip = handle_.velocity_mm_s() - axis * axis.dot(handle_.velocity_mm_s());
    const Vec3 force_n = axis * axial - robot_.line_stiffness_n_mm * sideways - line_damping_n_s_mm_ * slip;
    const Vec3 torque_n_mm = held_ * (-turn_stiffness_n_mm_rad * handle_.turn_rad(held_) -
                                      turn_damping_n_mm_s_rad * handle_.turn_rate_rad_s());
    const double per_simulated = 1.0 / script_.force_scale;
    input.world_from_handle = world_from_plan_ * handle_.plan_from_handle();
    input.hand_force_n = world_from_plan_.rotation * (per_simulated * force_n);
    input.hand_torque_n_mm = world_from_plan_.rotation * (per_simulated * torque_n_mm);
    return true;
  }

  RobotParameters robot_;
  Mat3 held_;
  double line_damping_n_s_mm_;
  CommandedPose handle_;
  Phase phase_ = Phase::approach;
  double since_s_ = 0.0, moved_s_ = 0.0, last_s_ = 0.0;
  double from_mm_ = 0.0;  ///< where it was held up
};

}  // namespace

std::unique_ptr<HapticDevice> make_robot_device(const Script& script, const Pose& world_from_plan) {
  return std::make_unique<RobotDevice>(script, world_from_plan);
}

}  // namespace ream::device
