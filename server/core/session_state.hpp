#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace ream {

/// Where a session stands. The numbers are those of SessionState of proto/stream.fbs. `replaying` is told to
/// viewers of a replay only: no session is ever in it.
enum class SessionState : uint8_t {
  created = 0,
  running = 1,
  paused = 2,
  finished = 3,
  stopped = 4,
  fault = 5,
  interrupted = 6,
  replaying = 7
};

/// The word of REST and session.json: "created", "running", ...
std::string to_text(SessionState state);
/// The state of a session with that word; empty for other words.
std::optional<SessionState> session_state_from(const std::string& text);

/// Whether it still runs or can: created, running or paused.
constexpr bool is_live(SessionState state) { return state <= SessionState::paused; }

}  // namespace ream
