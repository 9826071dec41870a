#pragma once
#include <filesystem>

#include "core/atomic_file.hpp"
#include "core/progress.hpp"
#include "voxelizer/voxel_set.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::voxelizer {

/// Writes the marked voxels as boxes to look at: a binary PLY file of the faces between a marked voxel and
/// one that is not, four vertices each, counter-clockwise from outside, mm. Throws Error invalid_input for
/// more faces than a PLY file can number.
void write_boxes(const VoxelSet& set, AtomicFile& file, const Progress& progress);

/// How a voxel stands in a NRRD file: a byte that is 1 or 0, or one bit, eight voxels along x in a byte, the
/// lowest bit first, each row beginning a byte. NRRD knows no bits: such a file has bytes of eight voxels,
/// and its key ream_dims says how many voxels there are.
enum class GridFormat { bytes, bits };

/// Writes the grid as an attached raw NRRD, space LPS, origin the centre of the first sample.
void write_nrrd(const VoxelSet& set, GridFormat format, AtomicFile& file, const Progress& progress);

/// The grid of a NRRD file: sizes, voxel size and origin, from its header alone. Throws Error: not_found;
/// invalid_input, naming file and reason, unless it has three axes along x, y and z.
RasterGrid grid_of_nrrd(const std::filesystem::path& path);

/// Writes the marked voxels as 64-bit Morton codes (thesis section 4.3, 21 bits an axis, u lowest) in rising
/// order: a one-dimensional little-endian NRRD whose keys ream_dims, ream_origin_mm and ream_size_mm describe
/// the grid.
void write_morton_codes(const VoxelSet& set, AtomicFile& file, const Progress& progress);

/// Writes the centres of the marked voxels as a binary PLY file of x, y, z (mm), unit normal and area_mm2.
/// The normal is the mean of the triangles in the voxel, each weighed by its part in it; 0 where no triangle
/// is (inside of solids) or where they cancel. The area is how much of the surface the voxel stands for: what
/// lies in it, or, in a 6-separating set, which has a voxel for each column of the surface, what the column
/// cuts from a plane of that normal. Its sum is the surface's area. `request` must be what the set was made
/// by.
void write_points(const TriangleMesh& mesh, const Request& request, const VoxelSet& set, AtomicFile& file,
                  const Progress& progress);

}  // namespace ream::voxelizer
