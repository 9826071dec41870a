#include "device/simulated/admittance_plant.hpp"

#include <array>
#include <atomic>
#include <random>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "device/script/script.hpp"
#include "device/simulated/hand_model.hpp"

namespace ream::device {
namespace {

constexpr size_t max_delay_ticks = 64;

/// The machine's mechanics: position control of one mass, after a delay.
class JointServo {
 public:
  explicit JointServo(const PlantParameters& plant)
      : omega_rad_s_(2.0 * pi * plant.servo_hz),
        own_stop_mm_s2_(plant.own_stop_mm_s2),
        delay_ticks_(static_cast<size_t>(plant.delay_ticks)) {}

  void begin(const Pose& at) noexcept {
    set_points_.fill(at);
    next_ = 0;
    measured_ = at;
    velocity_mm_s_.setZero();
  }
  void move_to(const Pose& at) noexcept {
    next_ = (next_ + 1) % max_delay_ticks;
    set_points_[next_] = at;
  }
  /// Turns are followed without the lag of the arm.
  void follow() noexcept {
    const Pose& delayed = set_points_[(next_ + max_delay_ticks - delay_ticks_) % max_delay_ticks];
    const double w = omega_rad_s_, t = tick_s;
    const Vec3 pull_mm_s = t * w * w * (delayed.translation_mm - measured_.translation_mm);
    const Pose before = measured_;
    velocity_mm_s_ = (velocity_mm_s_ + pull_mm_s) / (1.0 + 2.0 * w * t + w * w * t * t);
    measured_.translation_mm += t * velocity_mm_s_;
    measured_.rotation = delayed.rotation;
    turn_rate_rad_s_ = turn_between(before.rotation, measured_.rotation) / t;
  }
  void brake() noexcept {
    const double speed_mm_s = velocity_mm_s_.norm();
    const double left_mm_s = std::max(0.0, speed_mm_s - own_stop_mm_s2_ * tick_s);
    velocity_mm_s_ = left_mm_s > 0.0 ? Vec3(velocity_mm_s_ * (left_mm_s / speed_mm_s)) : Vec3(Vec3::Zero());
    measured_.translation_mm += tick_s * velocity_mm_s_;
    turn_rate_rad_s_.setZero();
  }

  const Pose& measured() const noexcept { return measured_; }
  const Vec3& velocity_mm_s() const noexcept { return velocity_mm_s_; }
  const Vec3& turn_rate_rad_s() const noexcept { return turn_rate_rad_s_; }

 private:
  const double omega_rad_s_, own_stop_mm_s2_;
  const size_t delay_ticks_;
  std::array<Pose, max_delay_ticks> set_points_;
  size_t next_ = 0;
  Pose measured_;
  Vec3 velocity_mm_s_ = Vec3::Zero(), turn_rate_rad_s_ = Vec3::Zero();
};

class AdmittancePlant final : public AdmittanceMachine {
 public:
  AdmittancePlant(const PlantParameters& plant, const DeviceTraits& traits, const Script& script,
                  uint64_t random_seed)
      : plant_(plant),
        traits_(traits),
        script_(script),
        hand_(script.hand, random_seed),
        servo_(plant),
        random_seed_(random_seed) {
    traits_.name = plant.name;
    traits_.simulated = true;
  }

  const DeviceTraits& traits() const noexcept override { return traits_; }
  const MachineLimits& limits() const noexcept override { return plant_.limits; }

  void open() override {
    hand_.begin();
    servo_.begin(hand_.plan_from_hand());
    random_.seed(random_seed_);
    tick_ = 0;
    enabled_ = just_enabled_ = session_paused_ = false;
    stopped_.store(false, std::memory_order_relaxed);
  }
  /// The first look after it is before any motion.
  void enable() override { enabled_ = just_enabled_ = true; }
  void session_paused(bool paused) noexcept override { session_paused_ = paused; }

  DeviceStatus sense(MachineSense& sense) noexcept override {
    const double t_s = static_cast<double>(tick_) * tick_s;
    if (t_s >= script_.duration_s) return DeviceStatus::finished;
    const TimedButtons buttons = buttons_at(script_.buttons, t_s);
    sense.spindle_on = buttons.spindle;
    sense.paused = buttons.pause;
    const bool moves = enabled_ && !just_enabled_;
    just_enabled_ = false;
    const Load on_handle = moves ? move(t_s, buttons.pause || session_paused_) : Load{};
    sense.base_from_handle = servo_.measured();
    sense.force_n = on_handle.force_n / script_.force_scale + plant_.sensor_bias_n;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      sense.force_n[axis] += plant_.sensor_noise_rms_n * noise_(random_);
    const double range_n = plant_.limits.sensor_range_n;
    sense.force_n = sense.force_n.cwiseMax(-range_n).cwiseMin(range_n);
    sense.torque_n_mm = on_handle.torque_n_mm / script_.force_scale;
    sense.age_ms = 0.0;
    return DeviceStatus::ok;
  }

  bool move_to(const Pose& base_from_handle) noexcept override {
    servo_.move_to(base_from_handle);
    return true;
  }
  void stop() noexcept override { stopped_.store(true, std::memory_order_relaxed); }
  void disable() noexcept override { enabled_ = false; }
  void close() noexcept override {}

 private:
  /// One tick of machine and hand; what the hand does to the handle, simulated newtons.
  Load move(double, bool paused) noexcept {
    if (stopped_.load(std::memory_order_relaxed))
      servo_.brake();
    else
      servo_.follow();
    const Load on_handle = hand_.grip(servo_.measured(), servo_.velocity_mm_s(), servo_.turn_rate_rad_s());
    if (paused)
      hand_.rest();
    else
      hand_.advance(force_at(script_.hand.force_profile, static_cast<double>(tick_) * tick_s),
                    {-on_handle.force_n, -on_handle.torque_n_mm});
    if (!session_paused_) ++tick_;
    return on_handle;
  }

  const PlantParameters plant_;
  DeviceTraits traits_;
  const Script script_;
  GrippingHand hand_;
  JointServo servo_;
  const uint64_t random_seed_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_{0.0, 1.0};
  int64_t tick_ = 0;
  bool enabled_ = false, just_enabled_ = false, session_paused_ = false;
  std::atomic<bool> stopped_{false};
};

}  // namespace

const PlantParameters& hapticmaster_plant() {
  static const PlantParameters plant{
      "hapticmaster-plant", {{1000.0, 50'000.0, 5.0, 100.0, 180.0}, 250.0, 20.0}, 60.0, 1, 50'000.0, 0.01,
      Vec3(1.5, -0.7, 3.0)};
  return plant;
}

const PlantParameters& robot_plant() {
  static const PlantParameters plant{
      "robot-plant",       {{250.0, 2'500.0, 1.0, 10.0, 400.0}, 200.0, 20.0}, 30.0, 4, 5'000.0, 0.1,
      Vec3(-4.0, 2.0, 9.0)};
  return plant;
}

std::unique_ptr<AdmittanceMachine> make_admittance_plant(const PlantParameters& plant,
                                                         const DeviceTraits& traits, const Script& script,
                                                         uint64_t random_seed) {
  if (script.kind != ScriptKind::hand)
    throw Error(ErrorKind::invalid_input,
                plant.name + " is held by a script's hand; name a script with \"device\": \"hand\"");
  return std::make_unique<AdmittancePlant>(plant, traits, script, random_seed);
}

}  // namespace ream::device
