#pragma once
#include "device/haptic_device.hpp"
#include "device/link_state.hpp"

namespace ream::sim {

/// What may still be done with what a device said, by the age of it.
device::LinkState link_state(double age_ms, const device::StaleLimits& limits) noexcept;

/// Stands between a device and the step (science.md 1.3). Up to StaleLimits::hold_ms the last pose is as good
/// as a new one, and up to fade_ms it is held. From there on the input is stale: the force on the hand fades
/// out, and the hand's own force counts for nothing. From lost_ms on the session rests, as after a pause,
/// until a pose comes that is not stale.
class PoseWatchdog {
 public:
  explicit PoseWatchdog(const device::StaleLimits& limits) : limits_(limits) {}

  /// Judges what was read for tick `tick`, and marks `input` as stale or paused.
  device::LinkState judge(uint32_t tick, device::DeviceInput& input) noexcept;

  device::LinkState state() const { return state_; }
  /// How often the device was lost after it had once been there, and when last; -1: never.
  uint64_t losses() const { return losses_; }
  int64_t lost_tick() const { return lost_tick_; }

 private:
  device::StaleLimits limits_;
  device::LinkState state_ = device::LinkState::lost;
  uint64_t losses_ = 0;
  int64_t lost_tick_ = -1;
  bool been_there_ = false;
};

}  // namespace ream::sim
