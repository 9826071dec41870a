#pragma once
#include <cstddef>
#include <cstdint>

#include "voxel/voxel_grid.hpp"

namespace ream::surface {

/// Coarse samples for slow links: sample i of an axis stands for the `stride` (2 or 4) voxels from i * stride
/// on. Its value is their mean, which puts surfaces where they are, sub-voxel and smooth. A wall thinner than
/// half a sample would vanish from means though, and reaming leaves such walls; so where voxels are filled
/// but neither the sample nor any of its 26 neighbours has a filled mean, the value is that of the fullest
/// voxel. (Around thicker bone the means say enough: beside a plane surface of any tilt, every sample that
/// holds a filled voxel has a neighbour with a filled mean.)
///
/// Writes edge^3 samples, x fastest, from sample `block_first` - 2 on in each axis; 0 outside the grid.
void coarse_samples(const voxel::VoxelGrid& grid, const uint8_t* coverage, const Vec3i& block_first, int edge,
                    int stride, uint8_t* samples, int row_bytes, int slice_bytes);

}  // namespace ream::surface
