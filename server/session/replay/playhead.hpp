#pragma once
#include <cstdint>

#include "session/running_replay.hpp"

namespace ream::session {

/// Where a replay stands and how it moves on: the arithmetic alone, without a clock of its own.
class Playhead {
 public:
  /// Rests at the start, at speed 1.
  explicit Playhead(uint32_t duration_ticks) : duration_ticks_(duration_ticks) {}

  /// Playing from the end begins at the start again. Error invalid_input naming the number that is out of
  /// range; nothing has changed then.
  void change(const PlaybackChange& change);
  /// Lets wall time pass. At the end it rests.
  void advance(int64_t elapsed_ns);
  /// Rests at `ticks`; the trace that viewers hold goes on from there.
  void rest_at(uint32_t ticks);

  /// Ticks of the recording that have passed, 0 to the duration.
  uint32_t position_ticks() const { return static_cast<uint32_t>(position_ticks_); }
  uint32_t duration_ticks() const { return duration_ticks_; }
  double speed() const { return speed_; }
  bool playing() const { return playing_; }
  /// Grows with every jump.
  uint32_t jumps() const { return jumps_; }

 private:
  const uint32_t duration_ticks_;
  double position_ticks_ = 0.0, speed_ = 1.0;
  bool playing_ = false;
  uint32_t jumps_ = 0;
};

}  // namespace ream::session
