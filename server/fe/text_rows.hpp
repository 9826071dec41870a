#pragma once
#include <filesystem>

#include "core/progress.hpp"
#include "fe/element_model.hpp"

namespace ream::fe {

/// Reads the thesis' text rows of a segmented bone: `x y z gray` a line, one line for each voxel that is
/// bone, in any order (section 2.1). x y z are voxel centres, LPS mm, on a regular grid of which any part may
/// be missing; or voxel indices, where a line `# spacing_mm X Y Z` says their size. Blanks, tabs, commas or
/// semicolons between; empty lines and those that begin with # are passed over. Memory is 12 bytes a row and
/// the grid's bits; what the budget has no room for goes to the disk. On two threads. Errors: invalid_input
/// naming file and line (no four numbers, a voxel off the grid or given twice), not_found, io, cancelled.
ElementModel read_text_rows(const std::filesystem::path& path, MemoryBudget& budget,
                            const Progress& progress = no_progress);

}  // namespace ream::fe
