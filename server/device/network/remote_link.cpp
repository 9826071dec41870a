#include "device/network/remote_link.hpp"

#include <algorithm>
#include <limits>

namespace ream::device {
namespace {

std::array<double, 3> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

void RemoteEnd::open() noexcept {
  newest_ = {};
  answered_ = 0;
  broken_ = false;
  link_->force_taken_away.store(false, std::memory_order_release);
}

bool RemoteEnd::take(RemoteInput& input) noexcept {
  const uint64_t connection = newest_.connection;
  const bool fresh = link_->input.take(newest_);
  const bool was_broken = broken_;
  broken_ = fresh && newest_.connection != connection;
  age_ms_ = newest_.connection == 0 || broken_
                ? std::numeric_limits<double>::infinity()
                : std::max(0.0, static_cast<double>(now_ns_() - newest_.arrived_ns) / ns_per_ms);
  if (broken_ || !(fresh || was_broken)) return false;
  input = newest_;
  answered_ = newest_.connection;
  return true;
}

void RemoteEnd::write(const DeviceOutput& output) noexcept {
  RemoteOutput remote;
  remote.written_ns = now_ns_();
  remote.connection = answered_;
  remote.tick = output.tick;
  remote.link = output.link;
  remote.engaged = output.engaged;
  remote.force_n = plain(output.force_n);
  remote.torque_n_mm = plain(output.torque_n_mm);
  remote.thrust_n = output.thrust_n;
  remote.vibration_g = output.vibration_g;
  link_->output.store(remote);
}

}  // namespace ream::device
