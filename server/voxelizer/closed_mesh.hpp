#pragma once
#include "geometry/triangle_mesh.hpp"

namespace ream::voxelizer {

/// Throws Error invalid_input unless every edge belongs to an even number of triangles, which is what parity
/// needs: holes, not cavities, crossings or doubled faces. Says how many edges are open and where the first
/// one is.
void require_closed(const TriangleMesh& mesh, double scale);

}  // namespace ream::voxelizer
