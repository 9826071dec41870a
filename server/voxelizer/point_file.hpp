#pragma once
#include "core/streamed_file.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::voxelizer {

/// Writes the centres of the marked voxels as a binary PLY file of x, y, z (mm), unit normal and area_mm2.
/// The normal is the mean of the triangles in the voxel, each weighed by its part in it; 0 where no triangle
/// is (inside of solids) or where they cancel. The area is how much of the surface the voxel stands for: what
/// lies in it, or, in a 6-separating set, which has a voxel for each column of the surface, what the column
/// cuts from a plane of that normal. Its sum is the surface's area. `request` must be what the set was made
/// by.
void write_points(const TriangleMesh& mesh, const Request& request, const VoxelSet& set, StreamedFile& file,
                  const Progress& progress);

}  // namespace ream::voxelizer
