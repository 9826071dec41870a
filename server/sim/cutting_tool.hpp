#pragma once
#include "force/feed_model.hpp"
#include "shell/tool.hpp"

namespace ream::sim {

/// What the feed models know of a tool. The lip follows the cutting surface outwards from its offset in
/// pieces of at most 0.1 mm as seen along the axis; walls along the axis and what lies under a wider part
/// inside of it cut nothing when the tool is fed. The seated area is that of the cutting surface within
/// `seated_depth_mm` (the plan's depth; at least 0.1 mm is taken) of its most protruding place, as in flat
/// bone.
force::CuttingTool cutting_tool(const shell::ToolProfile& profile, double seated_depth_mm);

}  // namespace ream::sim
