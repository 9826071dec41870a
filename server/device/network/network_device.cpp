#include "device/network/network_device.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "device/profiles.hpp"

namespace ream::device {
namespace {

/// A glide takes at least a tick, and no longer than this: then a late pose counts more than a smooth one.
constexpr double max_glide_ns = 50.0 * ns_per_ms, min_glide_ns = 1.0 * ns_per_ms;
/// Each time between two messages counts for this share of what is usual.
constexpr double smoothing = 0.125;

Pose pose_of(const RemoteInput& input) noexcept {
  return {rotation_from_quaternion(input.rotation_wxyz),
          Vec3(input.place_mm[0], input.place_mm[1], input.place_mm[2])};
}

}  // namespace

NetworkDevice::NetworkDevice(const std::string& profile, std::shared_ptr<RemoteLink> link,
                             int64_t (*now_ns)())
    : traits_(device_profile(profile)), end_(std::move(link), now_ns) {
  if (traits_.causality != Causality::impedance)
    throw Error(ErrorKind::invalid_input,
                "a device over the network takes a force and gives a pose; profile '" + profile +
                    "' is the other way about, choose an impedance device such as 'touch'");
  traits_.name = "network";
  traits_.force_expires_ms = static_cast<double>(output_too_old_ns) / ns_per_ms;
}

void NetworkDevice::open() {
  end_.open();
  connection_ = 0;
  interval_ns_ = min_glide_ns;
}

void NetworkDevice::close() noexcept { end_.write({}); }

void NetworkDevice::glide_to(const Pose& pose, int64_t now_ns) noexcept {
  const auto since_last_ns = static_cast<double>(newest_.arrived_ns - arrived_ns_);
  if (newest_.connection == connection_ && since_last_ns < traits_.stale.lost_ms * ns_per_ms) {
    from_ = gliding(now_ns);
    interval_ns_ =
        std::clamp(interval_ns_ + smoothing * (since_last_ns - interval_ns_), min_glide_ns, max_glide_ns);
  } else {
    from_ = pose;  // the hand has been elsewhere meanwhile, and nothing is known of its way
  }
  to_ = pose;
  since_ns_ = now_ns;
  arrived_ns_ = newest_.arrived_ns;
  connection_ = newest_.connection;
}

Pose NetworkDevice::gliding(int64_t now_ns) const noexcept {
  const double share = static_cast<double>(now_ns - since_ns_) / interval_ns_;
  if (share >= 1.0) return to_;
  return {orthonormalized(from_.rotation *
                          rotation_from_small_vector(share * turn_between(from_.rotation, to_.rotation))),
          from_.translation_mm + share * (to_.translation_mm - from_.translation_mm)};
}

DeviceStatus NetworkDevice::read(DeviceInput& input) noexcept {
  const int64_t now_ns = end_.now_ns();
  if (end_.take(newest_)) glide_to(pose_of(newest_), now_ns);
  if (connection_ != 0) input.world_from_handle = gliding(now_ns);
  input.age_ms = end_.age_ms();
  input.hand_force_n = Vec3(newest_.hand_force_n[0], newest_.hand_force_n[1], newest_.hand_force_n[2]);
  input.spindle_on = newest_.spindle_on;
  input.drive = newest_.drive;
  input.paused = newest_.paused;
  input.clutch = newest_.clutch;
  input.deadman = newest_.deadman;
  return DeviceStatus::ok;
}

DeviceStatus NetworkDevice::write(const DeviceOutput& output) noexcept {
  end_.write(output);
  return DeviceStatus::ok;
}

}  // namespace ream::device
