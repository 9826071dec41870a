#pragma once
#include <filesystem>

#include "core/progress.hpp"
#include "core/streamed_file.hpp"
#include "voxelizer/voxel_set.hpp"

namespace ream::voxelizer {

/// How a voxel stands in a NRRD file: a byte that is 1 or 0, or one bit, eight voxels along x in a byte, the
/// lowest bit first, each row beginning a byte. NRRD knows no bits: such a file has bytes of eight voxels,
/// and its key ream_dims says how many voxels there are.
enum class GridFormat { bytes, bits };

/// Writes the grid as an attached raw NRRD, space LPS, origin the centre of the first sample.
void write_nrrd(const VoxelSet& set, GridFormat format, StreamedFile& file, const Progress& progress);

/// The grid of a NRRD file: sizes, voxel size and origin, from its header alone. Throws Error: not_found;
/// invalid_input, naming file and reason, unless it has three axes along x, y and z.
RasterGrid grid_of_nrrd(const std::filesystem::path& path);

}  // namespace ream::voxelizer
