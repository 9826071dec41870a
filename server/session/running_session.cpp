#include "session/running_session.hpp"

namespace ream::session {

std::string to_text(SessionState state) {
  switch (state) {
    case SessionState::created:
      return "created";
    case SessionState::running:
      return "running";
    case SessionState::paused:
      return "paused";
    case SessionState::finished:
      return "finished";
    case SessionState::stopped:
      return "stopped";
    case SessionState::fault:
      return "fault";
    case SessionState::interrupted:
      return "interrupted";
  }
  return "fault";
}

std::optional<SessionState> session_state_from(const std::string& text) {
  for (const SessionState state :
       {SessionState::created, SessionState::running, SessionState::paused, SessionState::finished,
        SessionState::stopped, SessionState::fault, SessionState::interrupted})
    if (text == to_text(state)) return state;
  return std::nullopt;
}

bool is_live(SessionState state) {
  return state == SessionState::created || state == SessionState::running || state == SessionState::paused;
}

}  // namespace ream::session
