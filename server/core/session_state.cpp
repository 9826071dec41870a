#include "core/session_state.hpp"

#include <array>

namespace ream {
namespace {

constexpr std::array<const char*, 8> state_names{"created", "running", "paused",      "finished",
                                                 "stopped", "fault",   "interrupted", "replaying"};

}  // namespace

std::string to_text(SessionState state) { return state_names.at(static_cast<size_t>(state)); }

std::optional<SessionState> session_state_from(const std::string& text) {
  for (size_t i = 0; i < static_cast<size_t>(SessionState::replaying); ++i)
    if (text == state_names[i]) return static_cast<SessionState>(i);
  return std::nullopt;
}

}  // namespace ream
