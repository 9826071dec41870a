#pragma once
#include <vector>

#include "ct/hu_volume.hpp"
#include "ct/segment.hpp"

namespace ream::ct {

/// Distance in mm from every voxel's centre to the nearest set voxel's centre, 0 in set ones (Maurer, Qi and
/// Raghavan 2003). A mask without a set voxel gives infinity everywhere.
std::vector<float> distance_to_set_mm(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm);

/// Morphological closing with a ball: gaps and holes narrower than twice the radius are set. What lies beyond
/// the volume counts as unset and never opens or closes anything at its border.
Mask closed_by_ball(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm, double radius_mm);

}  // namespace ream::ct
