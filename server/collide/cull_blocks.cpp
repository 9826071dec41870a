#include "collide/cull_blocks.hpp"

#include <algorithm>

namespace ream::collide {
namespace {

/// Covers the rounding of the centre's coordinates and of the probes' places, voxels.
constexpr float slack_voxels = 1.0f;

}  // namespace

Culling::Culling(const NarrowPhaseInput& input, const Voi& voi, const QuantisedPose& grid_from_tool) noexcept
    : distance_(input.distance),
      voxel_from_tool_(voxel_from_tool(grid_from_tool, input.bone.grid)),
      low_mm_(voi.box_tool_mm.min.cast<float>()),
      high_mm_(voi.box_tool_mm.max.cast<float>()),
      voxels_per_mm_(static_cast<float>(1.0 / input.bone.grid.min_spacing_mm())) {}

float Culling::gap_voxels(const ContactShell& shell, uint32_t block) const noexcept {
  const Vec3f centre(shell.centre_x_mm[block], shell.centre_y_mm[block], shell.centre_z_mm[block]);
  const float radius = shell.radius_mm[block];
  const float outside_voi = (low_mm_ - centre).cwiseMax(centre - high_mm_).maxCoeff() - radius;
  if (outside_voi > 0.0f) return outside_voi * voxels_per_mm_;
  const float* m = voxel_from_tool_.m;
  const float* t = voxel_from_tool_.t;
  const float u = m[0] * centre.x() + m[1] * centre.y() + m[2] * centre.z() + t[0];
  const float v = m[3] * centre.x() + m[4] * centre.y() + m[5] * centre.z() + t[1];
  const float w = m[6] * centre.x() + m[7] * centre.y() + m[8] * centre.z() + t[2];
  return distance_.lower_bound_voxels(u, v, w) - radius * voxels_per_mm_ - slack_voxels;
}

}  // namespace ream::collide
