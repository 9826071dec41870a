#pragma once
#include <string>

#include "shell/tool.hpp"

namespace ream::shell {

/// True when the first word is one of make_tool's words (the rest may still be wrong), or for the name of a
/// built-in reamer.
bool is_parametric(const std::string& description);

/// What make_tool accepts, for messages.
inline constexpr const char* tool_forms =
    "use \"sphere R[,outer]\" or \"ellipse a,b\" (mm), optionally followed by \" nipple r,h\" and \" back "
    "H\"; "
    "the name of a reamer; or the path of a mesh";

/// The profile that the words describe: cutting cap from the apex at the origin, cylinder and flat back with
/// a shaft stub (smooth), and the nipple (guiding). Chord error of the cap at most 0.1 um. Error usage as
/// make_tool.
ToolProfile parametric_profile(const std::string& description);

}  // namespace ream::shell
