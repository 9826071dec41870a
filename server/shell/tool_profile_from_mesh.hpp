#pragma once
#include <string>

#include "shell/tool.hpp"

namespace ream::shell {

/// What a mesh is as a reamer.
struct MeasuredProfile {
  ToolProfile profile;   ///< tool frame: z = 0 at the apex of the cutting surface
  double apex_z_mm = 0;  ///< height of that apex in the mesh's frame
};

/// Measures the envelope that a mesh sweeps about its z axis (+z is the feed direction): the highest z at
/// each radius is the front, the lowest the back. A fall by over 1 mm near the axis is a nipple, which
/// guides; the front from there to the rim cuts; side wall and back are smooth. An open sheet is given a
/// back. Corners are within 5 um of the envelope. Throws Error invalid_input, naming `name`, when the mesh
/// does not reach the axis.
MeasuredProfile tool_profile_from_mesh(const TriangleMesh& mesh, const std::string& name);

}  // namespace ream::shell
