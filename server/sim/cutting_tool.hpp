#pragma once
#include "force/feed_model.hpp"
#include "shell/tool.hpp"

namespace ream::sim {

/// What the feed models know of a tool: its lips along the cutting surface, no piece longer than 0.1 mm, and
/// the area of that surface within `seated_depth_mm` (the plan's depth; at least 0.1 mm is taken) of its most
/// protruding place. Lips leave out what the axis' offset or a part of the surface farther ahead hides, and
/// walls along the axis.
force::CuttingTool cutting_tool(const shell::ToolProfile& profile, double seated_depth_mm);

}  // namespace ream::sim
