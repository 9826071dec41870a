#pragma once
#include <atomic>

#include "core/utc.hpp"

namespace ream::test {

/// A wall clock that goes on only when told to.
class HandClock {
 public:
  WallClock function() {
    return [this] { return UtcMoment(std::chrono::seconds(now_s_)); };
  }
  void pass(std::chrono::seconds time) { now_s_ += time.count(); }

 private:
  std::atomic<int64_t> now_s_{utc_moment("2026-01-31T12:00:00Z").time_since_epoch() /
                              std::chrono::seconds(1)};
};

}  // namespace ream::test
