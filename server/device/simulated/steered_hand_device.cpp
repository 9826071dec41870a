#include "device/simulated/steered_hand_device.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "device/network/remote_link.hpp"
#include "device/profiles.hpp"
#include "device/simulated/hand_model.hpp"

namespace ream::device {
namespace {

/// How a hand follows a wish. Engineering choice.
/// Its arm is slower than a script's, so that a push of 120 N goes through the air at 60 mm/s.
constexpr double arm_damping_n_s_mm = 2.0;
/// Before and behind the planned entry; the hand goes no farther along its line.
constexpr double reach_mm = 60.0;
constexpr double follow_time_s = 0.04;
constexpr double push_rate_n_s = 400.0, sideways_rate_mm_s = 60.0, lean_rate_rad_s = 1.0;
/// The line goes no farther ahead of the hand than this: with the model's guide stiffness it pulls with 80 N.
constexpr double line_ahead_mm = 4.0;
/// Over which the push of a hand that hears nothing falls to nothing: as the force on it does.
constexpr double release_ms = 20.0;

/// One tick of the way from `now` to `command`: quick at first, but no quicker than `rate` a second.
Vec3 towards(const Vec3& now, const Vec3& command, double rate) {
  return now + clamp_length((tick_s / follow_time_s) * (command - now), rate * tick_s);
}

/// The turn that takes the plan's z axis to `axis` (unit, not against it) the short way; exact, as the Cayley
/// map turns by twice the angle whose tangent is half the vector's length.
Vec3 turn_of_axis(const Vec3& axis) { return Vec3::UnitZ().cross(axis) * (2.0 / (1.0 + axis.z())); }

HandParameters steered_hand() {
  HandParameters hand;
  hand.arm_damping_n_s_mm = arm_damping_n_s_mm;
  return hand;
}

class SteeredHandDevice final : public HapticDevice {
 public:
  SteeredHandDevice(const std::string& profile, const Pose& world_from_plan, double force_scale,
                    std::shared_ptr<RemoteLink> link, int64_t (*now_ns)())
      : traits_(device_profile(profile)),
        world_from_plan_(world_from_plan),
        force_scale_(force_scale),
        end_(std::move(link), now_ns),
        hand_(steered_hand(), 1) {
    if (traits_.causality != Causality::impedance)
      throw Error(ErrorKind::invalid_input,
                  "a hand in the browser feels through an impedance device; profile '" + profile +
                      "' is none, choose 'ideal'");
    traits_.name = "browser";
    traits_.simulated = true;
    traits_.stale = browser_stale_limits;
  }

  const DeviceTraits& traits() const noexcept override { return traits_; }

  void open() override {
    end_.open();
    hand_.begin();
    sideways_mm_ = lean_ = felt_.force_n = felt_.torque_n_mm = Vec3::Zero();
    push_n_ = 0.0;
    session_paused_ = false;
  }

  void close() noexcept override { end_.write({}); }

  void take_force_away() noexcept override { end_.take_force_away(); }

  void session_paused(bool paused) noexcept override { session_paused_ = paused; }
  double closing_ms() const noexcept override { return 0.0; }
  void use_priority(int) noexcept override {}

  DeviceStatus read(DeviceInput& input) noexcept override {
    end_.take(command_);
    input.age_ms = end_.age_ms();
    input.spindle_on = command_.spindle_on;
    input.drive = command_.drive;
    input.paused = command_.paused || session_paused_;
    if (input.paused || end_.age_ms() >= traits_.stale.lost_ms)
      rest();
    else
      follow();
    input.world_from_handle = world_from_plan_ * hand_.plan_from_hand();
    return DeviceStatus::ok;
  }

  DeviceStatus write(const DeviceOutput& output) noexcept override {
    const Mat3 plan_from_world = world_from_plan_.rotation.transpose();
    felt_.force_n = force_scale_ * (plan_from_world * (output.force_n - output.vibration_n));
    end_.write(output);
    return DeviceStatus::ok;
  }

 private:
  void rest() noexcept {
    hand_.rest();
    push_n_ = 0.0;
  }

  void follow() noexcept {
    const Vec3 hand_mm = hand_.plan_from_hand().translation_mm;
    lean_ = towards(lean_, commanded_lean(), lean_rate_rad_s);
    const Mat3 held = rotation_from_small_vector(lean_);
    Vec3 sideways_mm = towards(sideways_mm_, commanded_sideways_mm(), sideways_rate_mm_s);
    // A line that the bone keeps the hand from waits for it.
    const Vec3 ahead_mm = off_line_mm(sideways_mm, hand_mm, held.col(2));
    if (ahead_mm.norm() > line_ahead_mm &&
        ahead_mm.norm() > off_line_mm(sideways_mm_, hand_mm, held.col(2)).norm())
      sideways_mm = sideways_mm_;
    sideways_mm_ = sideways_mm;
    push_n_ = towards(Vec3(0, 0, push_n_), Vec3(0, 0, commanded_push_n()), push_rate_n_s).z();
    const bool at_its_end = push_n_ * hand_mm.z() > 0.0 && std::abs(hand_mm.z()) > reach_mm;
    hand_.hold(sideways_mm_, held);
    hand_.advance(at_its_end ? 0.0 : push_n_ * grip(), felt_);
  }

  /// From the hand to the line through `on_line_mm` along `axis`.
  static Vec3 off_line_mm(const Vec3& on_line_mm, const Vec3& hand_mm, const Vec3& axis) {
    const Vec3 way = on_line_mm - hand_mm;
    return way - axis * axis.dot(way);
  }

  /// 1 while poses come; falls to nothing when they do not.
  double grip() const noexcept {
    return std::clamp(1.0 - (end_.age_ms() - traits_.stale.fade_ms) / release_ms, 0.0, 1.0);
  }

  Vec3 in_plan(const std::array<double, 3>& world) const noexcept {
    return world_from_plan_.rotation.transpose() * Vec3(world[0], world[1], world[2]);
  }

  /// As a rotation vector of the Cayley map.
  Vec3 commanded_lean() const noexcept {
    const Vec3 command = in_plan(command_.lean);
    const double length = command.norm();
    if (length == 0.0) return Vec3::Zero();
    const Vec3 axis = command / length;
    const double max_length = 2.0 * std::tan(0.5 * SteeringLimits::max_lean_rad);
    // Backwards: as far as it goes, that way.
    if (axis.z() <= 0.0) return clamp_length(1.0e6 * Vec3::UnitZ().cross(axis), max_length);
    return clamp_length(turn_of_axis(axis), max_length);
  }

  Vec3 commanded_sideways_mm() const noexcept {
    Vec3 command = in_plan(command_.sideways_mm);
    command.z() = 0.0;
    return clamp_length(command, SteeringLimits::max_sideways_mm);
  }

  double commanded_push_n() const noexcept {
    return std::clamp(command_.push_n, SteeringLimits::min_push_n, SteeringLimits::max_push_n);
  }

  DeviceTraits traits_;
  const Pose world_from_plan_;
  const double force_scale_;
  RemoteEnd end_;
  RemoteInput command_;
  HandModel hand_;
  Vec3 sideways_mm_ = Vec3::Zero(), lean_ = Vec3::Zero();
  double push_n_ = 0.0;
  bool session_paused_ = false;
  Load felt_;  ///< of the last tick
};

}  // namespace

std::unique_ptr<HapticDevice> make_steered_hand_device(const std::string& profile,
                                                       const Pose& world_from_plan, double force_scale,
                                                       std::shared_ptr<RemoteLink> link,
                                                       int64_t (*now_ns)()) {
  return std::make_unique<SteeredHandDevice>(profile, world_from_plan, force_scale, std::move(link), now_ns);
}

}  // namespace ream::device
