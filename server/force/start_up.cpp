#include "force/start_up.hpp"

#include <algorithm>

#include "core/clock.hpp"

namespace ream::force {

double StartUpRamp::next(double wanted_n) noexcept {
  if (gain_ >= 1.0) return gain_;
  if (small_seen_ < small_ticks && waited_++ < longest_wait_ticks)
    small_seen_ = wanted_n < small_force_n ? small_seen_ + 1 : 0;
  else
    gain_ = std::min(1.0, gain_ + tick_s / ramp_s_);
  return gain_;
}

}  // namespace ream::force
