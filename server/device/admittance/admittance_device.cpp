#include "device/admittance/admittance_device.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <thread>

#include "core/clock.hpp"
#include "core/error.hpp"

namespace ream::device {
namespace {

/// How firmly tool and machine keep together where limits hold the machine back, critically damped.
constexpr double holding_rad_s = 30.0;
/// Nothing said for so long while the sensor is zeroed: it is not there.
constexpr int max_silent_samples = 500;

}  // namespace

AdmittanceDevice::AdmittanceDevice(std::unique_ptr<AdmittanceMachine> machine, const Pose& world_from_start)
    : machine_(std::move(machine)), world_from_start_(world_from_start), limiter_(machine_->limits().motion) {
  if (machine_->traits().causality != Causality::admittance)
    throw Error(ErrorKind::invalid_input,
                machine_->traits().name + " takes a force; a device that moves needs an admittance profile");
}

AdmittanceDevice::~AdmittanceDevice() { close(); }

bool AdmittanceDevice::is_good(const MachineSense& sense) const noexcept {
  return sense.base_from_handle.rotation.allFinite() && sense.base_from_handle.translation_mm.allFinite() &&
         sense.force_n.allFinite() && sense.torque_n_mm.allFinite() && std::isfinite(sense.age_ms) &&
         sense.force_n.cwiseAbs().maxCoeff() < clipped_share * machine_->limits().sensor_range_n;
}

/// Real machines say something new once a millisecond; simulated ones whenever they are asked.
void AdmittanceDevice::pace() const {
  if (!traits().simulated) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void AdmittanceDevice::open() {
  close();
  machine_->open();
  opened_ = true;
  halted_ = false;
  try {
    zero_sensor();
    limiter_.begin(last_sense_.base_from_handle);
    machine_->enable();
    enabled_ = true;
    require_still();
  } catch (...) {
    close();
    throw;
  }
  limiter_.begin(last_sense_.base_from_handle);
  world_from_base_ = world_from_start_ * last_sense_.base_from_handle.inverse();
  base_from_world_ = world_from_base_.inverse();
  offset_mm_ = tool_velocity_mm_s_ = Vec3::Zero();
  tool_mm_ = last_sense_.base_from_handle.translation_mm;
  silent_ms_ = 0.0;
  rests_ = true;
  session_paused_ = false;
}

void AdmittanceDevice::zero_sensor() {
  const std::string who = traits().name + ": ";
  Eigen::AlignedBox3d spread_n;
  Vec3 force_n = Vec3::Zero(), torque_n_mm = Vec3::Zero();
  int good = 0;
  for (int silent = 0; good < zeroing_samples; pace()) {
    MachineSense sense;
    if (machine_->sense(sense) != DeviceStatus::ok)
      throw Error(ErrorKind::unavailable, who + "it cannot be read; check its cable and power");
    if (!is_good(sense) || sense.age_ms > traits().stale.hold_ms) {
      if (++silent > max_silent_samples)
        throw Error(
            ErrorKind::unavailable,
            who + "its force sensor is silent or beyond its range; check it, and let go of the handle");
      continue;
    }
    last_sense_ = sense;
    spread_n.extend(sense.force_n);
    force_n += sense.force_n;
    torque_n_mm += sense.torque_n_mm;
    ++good;
  }
  if (spread_n.sizes().maxCoeff() > zeroing_spread_n)
    throw Error(ErrorKind::unavailable, who + "let go of the handle while its force sensor is zeroed");
  zero_n_ = force_n / zeroing_samples;
  zero_n_mm_ = torque_n_mm / zeroing_samples;
}

/// The motors are on: from the pose that they hold the set points begin, not from the one before.
void AdmittanceDevice::require_still() {
  const std::string who = traits().name + ": ";
  pace();
  MachineSense sense;
  if (machine_->sense(sense) != DeviceStatus::ok)
    throw Error(ErrorKind::unavailable, who + "it cannot be read since its motors are on; check its cable");
  if (!is_good(sense) || sense.age_ms > traits().stale.hold_ms)
    throw Error(
        ErrorKind::unavailable,
        who + "its sensor is silent or beyond its range since its motors are on; let go of the handle");
  const Pose &before = last_sense_.base_from_handle, &now = sense.base_from_handle;
  if ((now.translation_mm - before.translation_mm).norm() > enabling_moves_max_mm ||
      turn_between(before.rotation, now.rotation).norm() > enabling_turns_max_rad)
    throw Error(ErrorKind::unavailable,
                who +
                    "it moved when its motors went on; check its brakes and its controller, and let go of "
                    "the handle");
  last_sense_ = sense;
}

void AdmittanceDevice::session_paused(bool paused) noexcept {
  session_paused_ = paused;
  machine_->session_paused(paused);
}

/// Where the limits hold the machine back from the tool, what draws the tool to it, base frame.
Vec3 AdmittanceDevice::following_force_n() const noexcept {
  const double mass = n_per_kg_mm_s2 * traits().effective_mass_kg;
  const Vec3 behind_mm = limiter_.now().translation_mm - tool_mm_;
  const Vec3 slower_mm_s = limiter_.velocity_mm_s() - tool_velocity_mm_s_;
  return mass * holding_rad_s * (holding_rad_s * behind_mm + 2.0 * slower_mm_s);
}

/// Whatever its sensor says: a machine that runs into something clips it.
bool AdmittanceDevice::has_strayed(const MachineSense& sense) const noexcept {
  const Vec3& place_mm = sense.base_from_handle.translation_mm;
  return place_mm.allFinite() &&
         (place_mm - limiter_.now().translation_mm).norm() > machine_->limits().following_error_max_mm;
}

/// Its own stop, after which it is told no more set points.
void AdmittanceDevice::halt() noexcept {
  if (!halted_) machine_->stop();
  halted_ = true;
}

DeviceStatus AdmittanceDevice::read(DeviceInput& input) noexcept {
  MachineSense sense = last_sense_;
  const DeviceStatus status = machine_->sense(sense);
  if (status != DeviceStatus::ok) return status;
  silent_ms_ += tick_ms;
  if (is_good(sense)) {
    silent_ms_ = 0.0;
    last_sense_ = sense;
  }
  if (halted_ || has_strayed(sense)) {
    halt();
    return DeviceStatus::fault;
  }
  const StaleLimits& stale = traits().stale;
  input.age_ms = last_sense_.age_ms + silent_ms_;
  input.deadman = last_sense_.deadman;
  input.spindle_on = last_sense_.spindle_on && last_sense_.deadman;
  input.paused =
      last_sense_.paused || session_paused_ || !last_sense_.deadman || input.age_ms >= stale.lost_ms;
  const bool rests = input.paused || input.age_ms >= stale.fade_ms;
  input.world_from_handle = world_from_base_ * last_sense_.base_from_handle;
  const Vec3 drawn_n = rests || rests_ ? Vec3(Vec3::Zero()) : following_force_n();
  input.hand_force_n = world_from_base_.rotation * (last_sense_.force_n - zero_n_ + drawn_n);
  input.hand_torque_n_mm = world_from_base_.rotation * (last_sense_.torque_n_mm - zero_n_mm_);
  rests_ = rests;
  return DeviceStatus::ok;
}

DeviceStatus AdmittanceDevice::write(const DeviceOutput& output) noexcept {
  if (halted_) return DeviceStatus::fault;
  if (rests_ || !output.world_from_tool) {
    limiter_.brake();
    if (output.world_from_tool)  // from where it rests it goes on
      offset_mm_ =
          limiter_.now().translation_mm - (base_from_world_ * *output.world_from_tool).translation_mm;
    tool_mm_ = limiter_.now().translation_mm;
    tool_velocity_mm_s_ = limiter_.velocity_mm_s();
  } else {
    Pose target = base_from_world_ * *output.world_from_tool;
    target.translation_mm += offset_mm_;
    tool_velocity_mm_s_ = (target.translation_mm - tool_mm_) / tick_s;
    tool_mm_ = target.translation_mm;
    limiter_.toward(target);
  }
  return machine_->move_to(limiter_.now()) ? DeviceStatus::ok : DeviceStatus::fault;
}

/// Twice what it takes from its largest speed.
double AdmittanceDevice::braking_ms() const noexcept {
  return 2e3 * machine_->limits().motion.stop_time_s() + tick_ms;
}

double AdmittanceDevice::closing_ms() const noexcept {
  // Each tick of the braking may come late.
  return 2.0 * braking_ms() + release_ms;
}

/// The loop has ended, so that waiting is allowed.
void AdmittanceDevice::brake_to_rest() noexcept {
  const auto max_ticks = static_cast<int>(braking_ms() / tick_ms);
  MachineSense ignored;
  // Halted it brakes by itself, and is given the time for it.
  for (int i = 0; i < max_ticks && (halted_ || !limiter_.at_rest()); ++i) {
    limiter_.brake();
    machine_->sense(ignored);
    if (!halted_ && !machine_->move_to(limiter_.now())) break;
    pace();
  }
  halt();
}

void AdmittanceDevice::close() noexcept {
  if (!opened_) return;
  if (enabled_) brake_to_rest();
  enabled_ = opened_ = false;
  machine_->disable();
  machine_->close();
}

}  // namespace ream::device
