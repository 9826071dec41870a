#include "device/mapped_device.hpp"

#include "core/clock.hpp"

namespace ream::device {
namespace {

DeviceTraits seen_from_the_world(DeviceTraits traits, double scale) {
  traits.torque_max_n_mm *= scale;
  traits.stiffness_max_n_mm /= scale;
  traits.angular_stiffness_max_n_mm_rad *= scale;
  traits.damping_max_n_s_mm /= scale;
  traits.workspace_radius_mm *= scale;
  traits.effective_mass_kg /= scale;
  return traits;
}

bool is_finite(const DeviceInput& input) noexcept {
  return input.world_from_handle.rotation.allFinite() && input.world_from_handle.translation_mm.allFinite() &&
         input.hand_force_n.allFinite() && input.hand_torque_n_mm.allFinite();
}

}  // namespace

MappedDevice::MappedDevice(std::unique_ptr<HapticDevice> device, const DeviceSetup& setup,
                           const Pose& world_from_start)
    : device_(std::move(device)),
      world_from_device_(world_from_person(world_from_start.rotation.col(2)) * setup.person_from_device),
      handle_from_tool_(device::handle_from_tool(setup)),
      scale_(setup.scale),
      world_from_start_(world_from_start),
      traits_(seen_from_the_world(device_->traits(), setup.scale)),
      world_from_handle_(world_from_start) {}

void MappedDevice::open() {
  device_->open();
  sensed_ = {};
  world_from_handle_ = world_from_start_;
  silent_ms_ = 0.0;
  rests_ = turning_ = true;
  session_paused_ = false;
}

void MappedDevice::session_paused(bool paused) noexcept {
  session_paused_ = paused;
  device_->session_paused(paused);
}

Vec3 MappedDevice::mapped_mm(const Vec3& device_mm) const noexcept {
  return world_from_device_ * (scale_ * device_mm);
}

DeviceStatus MappedDevice::read(DeviceInput& input) noexcept {
  DeviceInput sensed = sensed_;
  const DeviceStatus status = device_->read(sensed);
  if (status != DeviceStatus::ok) return status;
  const double since_ms = sensed_.age_ms + silent_ms_ + tick_ms;
  silent_ms_ += tick_ms;
  if (is_finite(sensed)) {
    silent_ms_ = 0.0;
    sensed_ = sensed;
  }
  input.age_ms = sensed_.age_ms + silent_ms_;
  input.clutch = sensed_.clutch;
  input.deadman = sensed_.deadman;
  input.paused = sensed_.paused || session_paused_ || sensed_.clutch || !sensed_.deadman ||
                 input.age_ms >= traits_.stale.lost_ms;
  input.spindle_on = sensed_.spindle_on && sensed_.deadman;
  input.drive = sensed_.drive;
  follow(input.paused, since_ms);
  input.world_from_handle = world_from_handle_;
  input.hand_force_n = world_from_device_ * sensed_.hand_force_n;
  input.hand_torque_n_mm = world_from_device_ * (scale_ * sensed_.hand_torque_n_mm);
  return DeviceStatus::ok;
}

void MappedDevice::follow(bool rests, double since_ms) noexcept {
  const Vec3 place_mm = sensed_.world_from_handle.translation_mm;
  const bool jumped = (place_mm - last_mm_).norm() > max_hand_speed_mm_s * 1e-3 * since_ms;
  if (rests || rests_ || jumped) offset_mm_ = world_from_handle_.translation_mm - mapped_mm(place_mm);
  world_from_handle_.translation_mm = offset_mm_ + mapped_mm(place_mm);
  if (!rests) turn_to(world_from_device_ * sensed_.world_from_handle.rotation * handle_from_tool_);
  turning_ |= rests;
  rests_ = rests;
  last_mm_ = place_mm;
}

void MappedDevice::turn_to(const Mat3& world_from_tool) noexcept {
  const Vec3 turn_rad = turn_between(world_from_handle_.rotation, world_from_tool);
  const double step_rad = turn_rate_rad_s * tick_s, angle_rad = turn_rad.norm();
  turning_ &= angle_rad > step_rad;
  world_from_handle_.rotation =
      turning_ ? orthonormalized(world_from_handle_.rotation *
                                 rotation_from_small_vector(turn_rad * (step_rad / angle_rad)))
               : world_from_tool;
}

DeviceStatus MappedDevice::write(const DeviceOutput& output) noexcept {
  const Mat3 device_from_world = world_from_device_.transpose();
  DeviceOutput mapped = output;
  mapped.force_n = device_from_world * output.force_n;
  mapped.vibration_n = device_from_world * output.vibration_n;
  mapped.torque_n_mm = device_from_world * (output.torque_n_mm / scale_);
  if (output.world_from_tool)
    mapped.world_from_tool =
        Pose{device_from_world * output.world_from_tool->rotation * handle_from_tool_.transpose(),
             device_from_world * (output.world_from_tool->translation_mm - offset_mm_) / scale_};
  if (rests_) {
    mapped.force_n = mapped.torque_n_mm = mapped.vibration_n = Vec3::Zero();
    mapped.world_from_tool.reset();
  }
  return device_->write(mapped);
}

}  // namespace ream::device
