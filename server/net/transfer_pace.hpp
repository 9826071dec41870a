#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>

namespace ream::net {

/// Until when a transfer must have moved on. The peer has `grace` at first, every byte earns it more time at
/// the least rate, and no stall may be longer than `stall`.
class TransferPace {
 public:
  using Clock = std::chrono::steady_clock;

  TransferPace() = default;
  TransferPace(Clock::time_point begin, std::chrono::milliseconds grace, std::chrono::milliseconds stall,
               size_t min_bytes_per_s)
      : earned_until_(begin + grace), stall_(stall), ns_per_byte_(1'000'000'000 / min_bytes_per_s) {}

  void moved(size_t bytes) { earned_until_ += ns_per_byte_ * bytes; }

  /// How long the next bytes may take; not negative.
  std::chrono::milliseconds time_left(Clock::time_point now) const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(earned_until_ - now);
    return std::clamp(left, std::chrono::milliseconds(0), stall_);
  }

 private:
  Clock::time_point earned_until_;
  std::chrono::milliseconds stall_{0};
  std::chrono::nanoseconds ns_per_byte_{0};
};

}  // namespace ream::net
