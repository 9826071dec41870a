#pragma once
#include "geometry/vec.hpp"

namespace ream::voxelizer {

/// Share of a triangle's area that lies in the unit cube from `low`, 0 for a triangle without area. Corners
/// and cube are in voxels, where shares are what they are in mm.
double share_in_voxel(const Vec3 corners[3], const Vec3& low);

}  // namespace ream::voxelizer
