#pragma once
#include <string>

#include "voxel/voxel_grid.hpp"

namespace ream::record {

/// A grid as JSON text, to the bit.
std::string grid_to_text(const voxel::VoxelGrid& grid);
/// Error invalid_input naming what is missing, or as voxel::validate().
voxel::VoxelGrid grid_from_text(const std::string& text);

}  // namespace ream::record
