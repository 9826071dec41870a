#include "collide/grid_affine.hpp"

namespace ream::collide {

GridAffine voxel_from_tool(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid) noexcept {
  const Pose pose = dequantised(grid_from_tool);
  GridAffine a{};
  for (int i = 0; i < 3; ++i) {
    const double voxels_per_mm = 1.0 / grid.spacing_mm[i];
    for (int j = 0; j < 3; ++j) a.m[3 * i + j] = static_cast<float>(pose.rotation(i, j) * voxels_per_mm);
    a.t[i] = static_cast<float>(pose.translation_mm[i] * voxels_per_mm);
  }
  return a;
}

GridAffine tool_from_voxel(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid) noexcept {
  const Pose pose = dequantised(grid_from_tool);
  GridAffine a{};
  for (int i = 0; i < 3; ++i) {
    double offset = 0.0;
    for (int j = 0; j < 3; ++j) {
      const double r = pose.rotation(j, i);
      a.m[3 * i + j] = static_cast<float>(r * grid.spacing_mm[j]);
      offset = offset + r * (0.5 * grid.spacing_mm[j] - pose.translation_mm[j]);
    }
    a.t[i] = static_cast<float>(offset);
  }
  return a;
}

}  // namespace ream::collide
