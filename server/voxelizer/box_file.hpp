#pragma once
#include "core/progress.hpp"
#include "core/streamed_file.hpp"
#include "voxelizer/voxel_set.hpp"

namespace ream::voxelizer {

/// Writes the marked voxels as boxes to look at: a binary PLY file of the faces between a marked voxel and
/// one that is not, four vertices each, counter-clockwise from outside, mm. Throws Error invalid_input for
/// more faces than a PLY file can number.
void write_boxes(const VoxelSet& set, StreamedFile& file, const Progress& progress);

}  // namespace ream::voxelizer
