#pragma once
#include <cstdint>

namespace ream::device {

/// How far what a device last said may still be trusted; see StaleLimits.
enum class LinkState : uint8_t { fresh, held, fading, lost };

/// One word for people and REST: "fresh", "held", "fading", "lost".
const char* to_text(LinkState state) noexcept;

}  // namespace ream::device
