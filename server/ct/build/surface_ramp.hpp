#pragma once
#include <cstdint>
#include <vector>

#include "voxel/voxel_grid.hpp"

namespace ream::ct {

/// Draws the surface of `coverage` (x fastest, of the grid's dimensions) as contact and removal take it: a
/// ramp across the surface one smallest voxel edge wide, coverage 128 + 255 d / edge with d the distance of a
/// voxel's centre from the surface, inwards positive; beyond it empty or full. A scan's own ramp is as wide
/// as its blur and ends in whatever soft tissue and noise leave beside bone, which would be felt as bone.
///
/// The surface is where coverage, interpolated between neighbouring voxels, is 127.5: each voxel keeps its
/// side. The distance is that of a plane through the crossings with the six neighbours (the first step of
/// redistancing a level set), exact for a plane whose coverage is linear across it; a border of
/// the grid is no surface. A voxel whose neighbours all lie on its side is at least half a smallest edge
/// away, as along the axis nearest to the normal the next voxel is at least 0.577 of it further on.
/// Deterministic; on two threads.
void redraw_surface_ramp(const voxel::VoxelGrid& grid, std::vector<uint8_t>& coverage);

}  // namespace ream::ct
