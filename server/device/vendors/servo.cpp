#include "device/vendors/servo.hpp"

#include <time.h>

#include <Eigen/LU>
#include <algorithm>

namespace ream::device {
namespace {

/// How far a told orientation may be from a rotation.
constexpr double rotation_within = 0.05;
constexpr int64_t poll_interval_ns = 50'000, early_ns = 150'000;

Vec3 vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

bool is_rotation(const Mat3& r) {
  return (r * r.transpose() - Mat3::Identity()).norm() < rotation_within && r.determinant() > 0.0;
}

void sleep_until(int64_t then_ns) noexcept {
  const timespec until{then_ns / 1'000'000'000, then_ns % 1'000'000'000};
  ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace

ServoEnd::ServoEnd(std::shared_ptr<RemoteLink> link, double force_max_n, double torque_max_n_mm,
                   int64_t (*clock_ns)())
    : link_(std::move(link)),
      force_max_n_(force_max_n),
      torque_max_n_mm_(torque_max_n_mm),
      now_ns_(clock_ns) {}

void ServoEnd::begin() noexcept {
  connection_ = link_->connections.fetch_add(1, std::memory_order_relaxed) + 1;
  link_->output.take(newest_);
}

bool ServoEnd::poll_output() noexcept {
  if (!link_->output.take(newest_)) return false;
  due_ns_ = newest_.written_ns + tick_ns;
  return true;
}

ServoForce ServoEnd::force() noexcept {
  poll_output();
  if (link_->force_taken_away.load(std::memory_order_acquire) || newest_.connection != connection_ ||
      now_ns_() - newest_.written_ns > output_too_old_ns)
    return {};
  const ServoForce desired{vec(newest_.force_n), vec(newest_.torque_n_mm)};
  if (!desired.force_n.allFinite() || !desired.torque_n_mm.allFinite()) return {};
  return {clamp_length(desired.force_n, force_max_n_), clamp_length(desired.torque_n_mm, torque_max_n_mm_)};
}

bool ServoEnd::report(const ServoState& state, int64_t sensed_ns) noexcept {
  const Pose& pose = state.device_from_handle;
  if (!is_rotation(pose.rotation) || !(pose.translation_mm.norm() <= max_distance_mm)) {
    link_->refused.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  RemoteInput input;
  input.arrived_ns = sensed_ns;
  input.connection = connection_;
  input.rotation_wxyz = quaternion_from_rotation(orthonormalized(pose.rotation));
  input.place_mm = {pose.translation_mm.x(), pose.translation_mm.y(), pose.translation_mm.z()};
  input.spindle_on = state.spindle_on;
  input.paused = state.paused;
  input.clutch = state.clutch;
  input.deadman = state.deadman;
  link_->input.store(input);
  link_->received.fetch_add(1, std::memory_order_relaxed);
  return true;
}

void ServoEnd::await_force(int64_t max_ns) noexcept {
  const int64_t until_ns = now_ns_() + max_ns;
  sleep_until(std::min(due_ns_ - early_ns, until_ns));
  while (!poll_output()) {
    const int64_t now = now_ns_();
    if (now >= until_ns) return;
    sleep_until(now + poll_interval_ns);
  }
}

}  // namespace ream::device
