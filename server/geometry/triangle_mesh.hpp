#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/box.hpp"

namespace ream {

/// Indexed triangles, counter-clockwise seen from outside. `normals` is empty or one unit vector per vertex.
struct TriangleMesh {
  std::vector<Vec3f> vertices_mm;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<Vec3f> normals;

  Aabb bounds() const;
  /// Signed volume by the divergence theorem, mm^3; meaningful for closed meshes.
  double volume_mm3() const;
  /// Vertices (and normals) in frame a of this mesh in frame b.
  TriangleMesh transformed(const Pose& a_from_b) const;
};

}  // namespace ream
