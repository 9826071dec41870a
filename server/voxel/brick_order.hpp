#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "voxel/voxel_grid.hpp"

namespace ream::voxel {

/// Files and CT filters keep voxels row after row (VoxelGrid::row_index), a BoneModel brick after brick
/// (VoxelGrid::index); these turn one into the other. Both sizes must be grid.voxel_count().
std::vector<uint8_t> bricks_from_rows(const VoxelGrid& grid, std::span<const uint8_t> rows);
std::vector<uint8_t> rows_from_bricks(const VoxelGrid& grid, std::span<const uint8_t> bricks);

}  // namespace ream::voxel
