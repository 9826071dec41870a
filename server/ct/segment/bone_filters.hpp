#pragma once
#include <vector>

#include "ct/hu_volume.hpp"
#include "ct/segment/mask.hpp"

namespace ream::ct {

/// Distance in mm from every voxel's centre to the nearest set voxel's centre, 0 in set ones (Maurer, Qi and
/// Raghavan 2003). A mask without a set voxel gives infinity everywhere.
std::vector<float> distance_to_set_mm(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm);

/// Morphological closing with a ball: gaps and holes narrower than twice the radius are set. What lies beyond
/// the volume counts as unset and never opens or closes anything at its border.
Mask closed_by_ball(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm, double radius_mm);

/// How far each voxel lies below the level to which a narrow valley about it would have to be filled, HU: the
/// black top-hat by a ball (grey closing less the value). High in a gap of less than twice the radius between
/// two denser sheets, about 0 in and outside wide bone.
std::vector<int16_t> valley_depth_hu(const std::vector<int16_t>& hu, const Vec3i& dims,
                                     const Vec3& spacing_mm, double radius_mm);

}  // namespace ream::ct
