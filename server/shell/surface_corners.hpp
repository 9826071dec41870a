#pragma once
#include <vector>

#include "shell/surface_voxelizer.hpp"

namespace ream::shell {

/// Mesh data of thesis section 3.2: nine floats a triangle, corner after corner, in cells of `grid` from its
/// minimum corner. Computed once in double on the host, so that both back ends start from the same bits and a
/// shared vertex is the same point in all its triangles.
std::vector<float> surface_corners(const TriangleMesh& mesh, const SurfaceVoxels& grid);

}  // namespace ream::shell
