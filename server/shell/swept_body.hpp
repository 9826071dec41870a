#pragma once
#include "shell/tool.hpp"

namespace ream::shell {

/// Meridian of what the cutting surface sweeps by spinning: from the axis (flat where a nipple stands) along
/// the cutting points, straight to `back_mm` behind the lowest of them, and back to the axis. Tool frame, mm.
/// Error invalid_input without a cutting surface.
ToolProfile swept_body(const ToolProfile& profile, double back_mm);

}  // namespace ream::shell
