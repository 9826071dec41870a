#pragma once
#include <string>

#include "geometry/triangle_mesh.hpp"
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

/// The body that a mesh sweeps by spinning about its z axis, seen from both ends. Exact for the mesh's
/// triangles: no sampling over the angle.
class MeshEnvelope {
 public:
  explicit MeshEnvelope(TriangleMesh mesh);

  /// Largest and smallest z of the surface on the circle of that radius; -infinity and +infinity where the
  /// surface has no point of that radius.
  double top_mm(double radius_mm) const { return extreme_z_mm(radius_mm, 1.0); }
  double bottom_mm(double radius_mm) const { return -extreme_z_mm(radius_mm, -1.0); }
  double max_radius_mm() const { return max_radius_mm_; }
  double min_radius_mm() const;

 private:
  double extreme_z_mm(double radius_mm, double sign) const;

  TriangleMesh mesh_;
  std::vector<double> nearest_radius_mm_, farthest_radius_mm_;  ///< per triangle
  double max_radius_mm_ = 0;
};

/// Axis and feed direction of a mesh that is mostly a surface of revolution, in the mesh's coordinates.
/// Normals of such a surface meet the axis, so the axis w through c minimises the sum of (n . (w x (p -
/// c)))^2 over the surface (Pottmann and Randrup 1998), with triangles that do not fit (lips, flutes) counted
/// ever less. The feed direction is the side on which the surface is domed. The point lies near the middle of
/// the mesh. Throws Error invalid_input, naming `name`, where the axis or the side is not clear.
ToolAxis estimate_axis(const TriangleMesh& mesh, const std::string& name);

}  // namespace ream::shell
