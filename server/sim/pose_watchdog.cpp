#include "sim/pose_watchdog.hpp"

namespace ream::sim {

using device::LinkState;

LinkState link_state(double age_ms, const device::StaleLimits& limits) noexcept {
  // An age that is not a number is as good as none.
  if (!(age_ms < limits.lost_ms)) return LinkState::lost;
  if (age_ms >= limits.fade_ms) return LinkState::fading;
  return age_ms >= limits.hold_ms ? LinkState::held : LinkState::fresh;
}

LinkState PoseWatchdog::judge(uint32_t tick, device::DeviceInput& input) noexcept {
  LinkState state = link_state(input.age_ms, limits_);
  if (state == LinkState::fading && state_ == LinkState::lost) state = LinkState::lost;
  if (state == LinkState::lost && state_ != LinkState::lost && been_there_) {
    ++losses_;
    lost_tick_ = tick;
  }
  been_there_ |= state != LinkState::lost;
  state_ = state;
  if (state >= LinkState::fading) {
    input.stale = true;
    input.hand_force_n = input.hand_torque_n_mm = Vec3::Zero();
  }
  input.paused |= state == LinkState::lost;
  return state;
}

}  // namespace ream::sim
