#pragma once
#include <string>

#include "shell/tool.hpp"

namespace ream::shell {

/// Axis and feed direction of a mesh that is mostly a surface of revolution, in the mesh's coordinates.
/// Normals of such a surface meet the axis, so the axis w through c minimises the sum of (n . (w x (p -
/// c)))^2 over the surface (Pottmann and Randrup 1998), with triangles that do not fit (lips, flutes) counted
/// ever less. The feed direction is the side on which the surface is domed. The point lies near the middle of
/// the mesh. Throws Error invalid_input, naming `name`, where the axis or the side is not clear.
ToolAxis estimate_axis(const TriangleMesh& mesh, const std::string& name);

}  // namespace ream::shell
