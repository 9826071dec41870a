#include "session/replay/playhead.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock.hpp"
#include "core/error.hpp"

namespace ream::session {
namespace {

std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

void Playhead::change(const PlaybackChange& change) {
  const double duration_s = duration_ticks_ * tick_s;
  if (change.speed && *change.speed != 0.0 &&
      !(*change.speed >= slowest_playback && *change.speed <= fastest_playback))
    throw Error(ErrorKind::invalid_input, "speed must be 0 or from " + number(slowest_playback) + " to " +
                                              number(fastest_playback) + ", not " + number(*change.speed));
  if (change.position_s && !(*change.position_s >= 0.0 && *change.position_s <= duration_s))
    throw Error(ErrorKind::invalid_input, "position_s must be from 0 to the duration, " + number(duration_s) +
                                              ", not " + number(*change.position_s));
  if (change.position_s) {
    position_ticks_ = std::min(std::round(*change.position_s / tick_s), static_cast<double>(duration_ticks_));
    ++jumps_;
  }
  if (change.speed && *change.speed > 0.0) speed_ = *change.speed;
  if (change.playing) playing_ = *change.playing;
  if (change.speed && *change.speed == 0.0) playing_ = false;
  if (change.playing && playing_ && !change.position_s && position_ticks() == duration_ticks_) {
    position_ticks_ = 0.0;
    ++jumps_;
  }
}

void Playhead::advance(int64_t elapsed_ns) {
  if (!playing_) return;
  position_ticks_ += static_cast<double>(elapsed_ns) / static_cast<double>(tick_ns) * speed_;
  if (position_ticks_ < duration_ticks_) return;
  position_ticks_ = duration_ticks_;
  playing_ = false;
}

void Playhead::rest_at(uint32_t ticks) {
  position_ticks_ = ticks;
  playing_ = false;
}

}  // namespace ream::session
