#pragma once
#include <filesystem>

#include "core/progress.hpp"
#include "ct/hu_volume.hpp"

namespace ream::ct {

/// Reads the thesis' text rows: `x y z gray` a line, one line a voxel of a regular grid, in any order.
/// Blanks, tabs, commas or semicolons between; empty lines and those that begin with # are passed over. x y z
/// are the voxel centres in LPS mm, or voxel indices: whole numbers from 0 without a gap, taken as voxels of
/// 1 mm unless a line `# spacing_mm X Y Z` stands before the rows; gray is rounded to a whole number and
/// clamped to 16 bits. The file is read twice in pieces; memory is the volume and one bit a voxel. Errors:
/// invalid_input naming the file and the line (no four numbers, a voxel off the grid or given twice, a voxel
/// missing), not_found, io, cancelled.
HuVolume read_text_rows(const std::filesystem::path& path, const Progress& progress = no_progress);

}  // namespace ream::ct
