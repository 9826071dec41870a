#include "core/session_state.hpp"

#include <array>

namespace ream {
namespace {

constexpr std::array<const char*, 8> names{"created", "running", "paused",      "finished",
                                           "stopped", "fault",   "interrupted", "replaying"};

}  // namespace

std::string to_text(SessionState state) { return names.at(static_cast<size_t>(state)); }

std::optional<SessionState> session_state_from(const std::string& text) {
  for (size_t i = 0; i < static_cast<size_t>(SessionState::replaying); ++i)
    if (text == names[i]) return static_cast<SessionState>(i);
  return std::nullopt;
}

}  // namespace ream
