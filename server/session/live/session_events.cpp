#include "session/live/session_events.hpp"

#include <cmath>

namespace ream::session {

std::vector<record::ops::Event> SessionEvents::of(const record::TickReport& report) {
  std::vector<record::ops::Event> events;
  const bool lost = report.link == device::LinkState::lost;
  if (lost && been_there_ && !lost_) events.push_back({report.tick, "device_lost", device_lost_words});
  if (!lost && begun_ && lost_)
    events.push_back({report.tick, "device_back",
                      been_there_ ? "The device has reconnected." : "The device is connected."});
  begun_ = true;
  been_there_ |= !lost;
  lost_ = lost;

  if (report.held != held_)
    events.push_back(report.held ? record::ops::Event{report.tick, "paused", "The session was paused."}
                                 : record::ops::Event{report.tick, "continued", "The session goes on."});
  held_ = report.held;

  if (!report.paused) {
    const bool started = report.spindle_on && !spindle_on_;
    if (started && report.engaged && report.thrust_n >= loaded_thrust_n)
      events.push_back({report.tick, "spindle_loaded",
                        "The spindle was started while pressed against bone with " +
                            std::to_string(std::lround(report.thrust_n)) +
                            " N; start it first, then approach."});
    spindle_on_ = report.spindle_on;
    if (report.stalled && !stalled_)
      events.push_back({report.tick, "spindle_stalled",
                        "The bone held the reamer still against " +
                            std::to_string(std::lround(report.thrust_n)) +
                            " N of thrust; draw back, and press less."});
    stalled_ = report.stalled;
  }
  return events;
}

std::string SessionEvents::device_words() const {
  if (!lost_) return "";
  return been_there_ ? device_lost_words : device_awaited_words;
}

}  // namespace ream::session
