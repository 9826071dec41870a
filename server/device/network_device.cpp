#include "device/network_device.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "device/profiles.hpp"

namespace ream::device {
namespace {

constexpr double ns_per_ms = 1.0e6;
/// A glide takes at least a tick, and no longer than this: then a late pose counts more than a smooth one.
constexpr double longest_glide_ns = 50.0 * ns_per_ms, shortest_glide_ns = 1.0 * ns_per_ms;
/// Each time between two messages counts for this share of what is usual.
constexpr double usual_share = 0.125;

std::array<double, 3> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Pose pose_of(const RemoteInput& input) noexcept {
  return {rotation_from_quaternion(input.rotation_wxyz),
          Vec3(input.place_mm[0], input.place_mm[1], input.place_mm[2])};
}

}  // namespace

bool InputAge::take(RemoteLink& link, RemoteInput& input, int64_t now_ns) noexcept {
  RemoteInput news;
  bool fresh = link.input.take(news);
  const bool new_connection = fresh && news.connection != waiting_.connection;
  if (fresh) waiting_ = news;
  if (new_connection) {
    broken_ = true;
    age_ms_ = std::numeric_limits<double>::infinity();
  } else {
    fresh |= broken_;
    broken_ = false;
    age_ms_ = waiting_.connection != 0
                  ? std::max(0.0, static_cast<double>(now_ns - waiting_.arrived_ns) / ns_per_ms)
                  : std::numeric_limits<double>::infinity();
  }
  link.state.store(state(), std::memory_order_relaxed);
  if (!fresh || broken_) return false;
  input = waiting_;
  return true;
}

LinkState InputAge::state() const noexcept {
  if (age_ms_ >= limits_.lost_ms) return LinkState::lost;
  if (age_ms_ >= limits_.fade_ms) return LinkState::fading;
  return age_ms_ >= limits_.hold_ms ? LinkState::held : LinkState::fresh;
}

RemoteOutput remote_output(const DeviceOutput& output, LinkState state, int64_t now_ns) noexcept {
  RemoteOutput remote;
  remote.written_ns = now_ns;
  remote.tick = output.tick;
  remote.link = state;
  remote.paused = output.paused;
  remote.engaged = output.engaged;
  remote.force_n = plain(output.force_n);
  remote.torque_n_mm = plain(output.torque_n_mm);
  remote.thrust_n = output.thrust_n;
  remote.vibration_g = output.vibration_g;
  return remote;
}

NetworkDevice::NetworkDevice(const std::string& profile, std::shared_ptr<RemoteLink> link,
                             int64_t (*now_ns)())
    : traits_(device_profile(profile)), link_(std::move(link)), now_ns_(now_ns), age_(traits_.stale) {
  if (traits_.causality != Causality::impedance)
    throw Error(ErrorKind::invalid_input,
                "a device over the network takes a force and gives a pose; profile '" + profile +
                    "' is the other way about, choose an impedance device such as 'touch'");
  traits_.name = "network";
}

void NetworkDevice::open() {
  age_ = InputAge(traits_.stale);
  connection_ = 0;
  between_ns_ = shortest_glide_ns;
  link_->force_taken_away.store(false, std::memory_order_release);
}

void NetworkDevice::close() noexcept { link_->output.store(remote_output({}, LinkState::lost, now_ns_())); }

void NetworkDevice::glide_to(const Pose& pose, int64_t now_ns) noexcept {
  const bool same_connection = newest_.connection == connection_;
  from_ = same_connection ? gliding(now_ns) : pose;  // between two connections there is no way to go
  to_ = pose;
  const double since_last_ns =
      same_connection ? static_cast<double>(newest_.arrived_ns - arrived_ns_) : shortest_glide_ns;
  between_ns_ = std::clamp(between_ns_ + usual_share * (since_last_ns - between_ns_), shortest_glide_ns,
                           longest_glide_ns);
  since_ns_ = now_ns;
  arrived_ns_ = newest_.arrived_ns;
  connection_ = newest_.connection;
}

Pose NetworkDevice::gliding(int64_t now_ns) const noexcept {
  const double share = static_cast<double>(now_ns - since_ns_) / between_ns_;
  if (share >= 1.0) return to_;
  return {orthonormalized(from_.rotation *
                          rotation_from_small_vector(share * turn_between(from_.rotation, to_.rotation))),
          from_.translation_mm + share * (to_.translation_mm - from_.translation_mm)};
}

DeviceStatus NetworkDevice::read(DeviceInput& input) noexcept {
  const int64_t now_ns = now_ns_();
  if (age_.take(*link_, newest_, now_ns)) glide_to(pose_of(newest_), now_ns);
  if (connection_ != 0) input.world_from_handle = gliding(now_ns);
  input.age_ms = age_.age_ms();
  input.hand_force_n = Vec3(newest_.hand_force_n[0], newest_.hand_force_n[1], newest_.hand_force_n[2]);
  input.spindle_on = newest_.spindle_on;
  input.paused = newest_.paused;
  input.clutch = newest_.clutch;
  input.deadman = newest_.deadman;
  return DeviceStatus::ok;
}

DeviceStatus NetworkDevice::write(const DeviceOutput& output) noexcept {
  link_->output.store(remote_output(output, age_.state(), now_ns_()));
  return DeviceStatus::ok;
}

}  // namespace ream::device
