#include "collide/cull_blocks.hpp"

#include <algorithm>

namespace ream::collide {
namespace {

/// Covers the rounding of the centre's coordinates and of the probes' places, voxels.
constexpr float slack_voxels = 1.0f;

Vec3f centre_of(const ContactShell& shell, uint32_t block) noexcept {
  return {shell.centre_x_mm[block], shell.centre_y_mm[block], shell.centre_z_mm[block]};
}

}  // namespace

BoneGap::BoneGap(const voxel::BrickDistance& distance, const voxel::VoxelGrid& grid,
                 const QuantisedPose& grid_from_tool) noexcept
    : distance_(distance),
      voxel_from_tool_(voxel_from_tool(grid_from_tool, grid)),
      voxels_per_mm_(static_cast<float>(1.0 / grid.min_spacing_mm())) {}

float BoneGap::voxels(const ContactShell& shell, uint32_t block) const noexcept {
  const Vec3f centre = centre_of(shell, block);
  const float* m = voxel_from_tool_.m;
  const float* t = voxel_from_tool_.t;
  const float u = m[0] * centre.x() + m[1] * centre.y() + m[2] * centre.z() + t[0];
  const float v = m[3] * centre.x() + m[4] * centre.y() + m[5] * centre.z() + t[1];
  const float w = m[6] * centre.x() + m[7] * centre.y() + m[8] * centre.z() + t[2];
  return distance_.lower_bound_voxels(u, v, w) - shell.radius_mm[block] * voxels_per_mm_;
}

Culling::Culling(const NarrowPhaseInput& input, const Voi& voi, const QuantisedPose& grid_from_tool) noexcept
    : gap_(input.distance, input.bone.grid, grid_from_tool),
      low_mm_(voi.box_tool_mm.min.cast<float>()),
      high_mm_(voi.box_tool_mm.max.cast<float>()) {}

float Culling::gap_voxels(const ContactShell& shell, uint32_t block) const noexcept {
  const Vec3f centre = centre_of(shell, block);
  const float outside_voi =
      (low_mm_ - centre).cwiseMax(centre - high_mm_).maxCoeff() - shell.radius_mm[block];
  if (outside_voi > 0.0f) return outside_voi * gap_.voxels_per_mm();
  return gap_.voxels(shell, block) - slack_voxels;
}

}  // namespace ream::collide
