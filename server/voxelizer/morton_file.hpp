#pragma once
#include "core/progress.hpp"
#include "core/streamed_file.hpp"
#include "voxelizer/voxel_set.hpp"

namespace ream::voxelizer {

/// Writes the marked voxels as 64-bit Morton codes (thesis section 4.3, 21 bits an axis, u lowest) in rising
/// order: a one-dimensional little-endian NRRD whose keys ream_dims, ream_origin_mm and ream_size_mm describe
/// the grid.
void write_morton_codes(const VoxelSet& set, StreamedFile& file, const Progress& progress);

}  // namespace ream::voxelizer
