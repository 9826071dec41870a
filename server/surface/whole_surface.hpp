#pragma once
#include <cstdint>

#include "geometry/triangle_mesh.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::surface {

/// The whole surface at coverage 127.5 as one closed mesh: grid frame, mm, vertices shared between blocks,
/// outward normals; for files and pictures. `coverage` has grid.voxel_count() bytes in the order of
/// VoxelGrid::index. `stride` as BlockExtractor. The same for the same coverage, whatever the number of
/// threads. Throws as validate() and BlockExtractor.
TriangleMesh whole_surface(const voxel::VoxelGrid& grid, const uint8_t* coverage, int threads = 2,
                           int stride = 1);

}  // namespace ream::surface
