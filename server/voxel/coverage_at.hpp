#pragma once
#include "voxel/bone_model.hpp"

namespace ream::voxel {

/// Coverage at a point of the grid frame (mm), trilinear between voxel centres; 0 outside the grid.
double coverage_at(const BoneModel& bone, const Vec3& point_mm);
/// The same of a coverage that somebody else holds, grid.voxel_count() bytes.
double coverage_at(const VoxelGrid& grid, const uint8_t* coverage, const Vec3& point_mm);

}  // namespace ream::voxel
