#pragma once
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ream {

/// A tree of boxes over a mesh's triangles that finds how far points lie from its surface. Holds a copy of
/// the corners that it needs; answers may be asked from several threads.
class TriangleTree {
 public:
  /// Of the triangles that touch `within`; all of them by default.
  explicit TriangleTree(const TriangleMesh& mesh, const Aabb* within = nullptr);

  /// Distance to the nearest triangle, mm; `limit_mm` when none is nearer.
  double distance_mm(const Vec3& point_mm, double limit_mm) const;
  bool empty() const { return triangles_.empty(); }

 private:
  struct Triangle {
    Vec3f a, b, c;
  };
  /// An inner node's children follow: the first at once, the second at `second`; a leaf holds `count`
  /// triangles from `first`.
  struct Node {
    Vec3f min, max;
    uint32_t first = 0, count = 0, second = 0;
  };

  uint32_t build(uint32_t first, uint32_t last);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

/// Distance from a point to a triangle, mm; degenerate triangles count as their edges.
double triangle_distance_mm(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace ream
