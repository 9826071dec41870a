#pragma once
#include <span>

#include "geometry/triangle_mesh.hpp"

namespace ream {

struct SplitMesh {
  TriangleMesh below, above;
};

/// A mesh along the line where what is said of its vertices (one value each, linear over triangles) is
/// `level`: triangles that the line crosses are cut there. Both parts keep orientation, and normals where
/// there are any; vertices of no triangle are left out.
SplitMesh split_at(const TriangleMesh& mesh, std::span<const float> values, float level);

}  // namespace ream
