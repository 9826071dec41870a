#pragma once
#include <vector>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// HU at a world point (LPS mm), trilinear between voxel centres; the edge's value beyond it.
double hu_at_world(const HuVolume& volume, const Vec3& world_mm);

/// Means over blocks of whole voxels, as many along each axis as come nearest to `size_mm`. Rows that fill no
/// block are left out. The same place in the world.
HuVolume coarsened(const HuVolume& volume, double size_mm);

/// Central differences in the volume's axes, HU per mm; 0 across the volume's border.
Vec3 gradient_hu_mm(const HuVolume& volume, const Vec3i& o);

/// Mean over 3 x 3 x 3 neighbours, beyond the border 0.
void blur(std::vector<float>& values, const Vec3i& dims);

}  // namespace ream::ct
