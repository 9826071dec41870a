#pragma once
#include <cstdint>
#include <vector>

#include "voxel/voxel_grid.hpp"

namespace ream::ct {

/// Draws the surface of `coverage` (x fastest, of the grid's dimensions) as contact and removal take it: a
/// ramp across the surface, `ramp_voxels` wide (above 0; its inner half at least half a voxel, so that a
/// voxel is full only where the scan says so); beyond it empty or full. A scan's own ramp is as wide as its
/// blur and ends in whatever soft tissue and noise leave beside bone, which would be felt as bone.
///
/// The surface is where coverage, interpolated between neighbouring voxels, is 127.5: each voxel keeps its
/// side. Its distance, in voxels, is what coverage lacks to it over how steeply coverage changes here, by the
/// steeper neighbour along each axis: exact for a plane across an axis under a linear ramp of a voxel or
/// more, within a tenth of a voxel for other planes, and within a quarter for steeper ramps. Voxels that are
/// longer along one axis have a longer ramp along it, as a surface could not lie between their centres
/// otherwise. A border of the grid is no surface. Deterministic; on two threads.
void redraw_surface_ramp(const voxel::VoxelGrid& grid, double ramp_voxels, std::vector<uint8_t>& coverage);

}  // namespace ream::ct
