#include "api/running_session.hpp"

namespace ream::api {

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
  }
  return "fault";
}

bool is_live(SessionState state) {
  return state == SessionState::created || state == SessionState::running || state == SessionState::paused;
}

}  // namespace ream::api
