#pragma once
#include "geometry/triangle_mesh.hpp"

namespace ream::shell {

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

}  // namespace ream::shell
