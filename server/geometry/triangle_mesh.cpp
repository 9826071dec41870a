#include "geometry/triangle_mesh.hpp"

#include <Eigen/Geometry>

namespace ream {

Aabb TriangleMesh::bounds() const {
  Aabb box;
  for (const Vec3f& v : vertices_mm) box.include(v.cast<double>());
  return box;
}

double TriangleMesh::volume_mm3() const {
  double six_volumes = 0.0;
  for (const auto& t : triangles) {
    const Vec3 a = vertices_mm[t[0]].cast<double>(), b = vertices_mm[t[1]].cast<double>(),
               c = vertices_mm[t[2]].cast<double>();
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

TriangleMesh TriangleMesh::transformed(const Pose& a_from_b) const {
  TriangleMesh out = *this;
  for (Vec3f& v : out.vertices_mm) v = a_from_b.point(v.cast<double>()).cast<float>();
  for (Vec3f& n : out.normals) n = a_from_b.direction(n.cast<double>()).cast<float>();
  return out;
}

}  // namespace ream
