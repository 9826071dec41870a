#pragma once
#include <string>
#include <vector>

#include "record/ops.hpp"
#include "record/tick_report.hpp"

namespace ream::session {

/// While its device is lost, in the words of a session for people.
inline constexpr const char* device_lost_words =
    "The device does not respond; the force is off. The session is paused until it reconnects.";
inline constexpr const char* device_awaited_words =
    "No device is connected yet; the session is paused until one is.";

/// Finds in the ticks of a session, one after the other, what its recording names as an event: the device was
/// lost or came (back), and the spindle was started while the reamer was already pressed against bone.
class SessionEvents {
 public:
  /// Pressed harder than this (simulated N) the reamer's lips have bitten before the spindle turns: what
  /// surgeons are taught to avoid. A reamer that only rests on bone weighs less. Engineering choice.
  static constexpr double loaded_thrust_n = 5.0;

  /// Those of this tick, with their kinds: "device_lost", "device_back", "spindle_loaded", "spindle_stalled",
  /// "paused" and "continued" (by somebody else than the device).
  std::vector<record::ops::Event> of(const record::TickReport& report);

  bool device_is_lost() const { return lost_; }
  /// What people should be told of the device now; empty while it answers.
  std::string device_words() const;

 private:
  bool begun_ = false, been_there_ = false, lost_ = false, held_ = false;
  bool stalled_ = false;
  bool spindle_on_ = true;  ///< in the last tick that was not paused; none before the first
};

}  // namespace ream::session
