#include "collide/contact/broad_phase.hpp"

#include <cmath>

namespace ream::collide {
namespace {

/// Covers the rounding of the centre's coordinates and of the probes' places, and that a point may be judged
/// by a voxel next to its own; voxels.
constexpr float slack_voxels = 2.0f;

Vec3f centre_of(const ContactShell& shell, uint32_t block) noexcept {
  return {shell.centre_x_mm[block], shell.centre_y_mm[block], shell.centre_z_mm[block]};
}

}  // namespace

bool overlap(const Obb& a, const Obb& b) noexcept {
  // b in a's axes; the small addition keeps cross products of parallel edges from separating by rounding.
  constexpr double parallel_guard = 1e-9;
  const Mat3 r = a.frame_from_box.rotation.transpose() * b.frame_from_box.rotation;
  const Mat3 abs_r = r.cwiseAbs().array() + parallel_guard;
  const Vec3 t = a.frame_from_box.rotation.transpose() *
                 (b.frame_from_box.translation_mm - a.frame_from_box.translation_mm);
  const Vec3 &ha = a.half_size, &hb = b.half_size;

  for (int i = 0; i < 3; ++i)
    if (std::abs(t[i]) > ha[i] + abs_r.row(i).dot(hb)) return false;
  for (int j = 0; j < 3; ++j)
    if (std::abs(t.dot(r.col(j))) > hb[j] + abs_r.col(j).dot(ha)) return false;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double distance = std::abs(t[i2] * r(i1, j) - t[i1] * r(i2, j));
      const double reach =
          ha[i1] * abs_r(i2, j) + ha[i2] * abs_r(i1, j) + hb[j1] * abs_r(i, j2) + hb[j2] * abs_r(i, j1);
      if (distance > reach) return false;
    }
  return true;
}

Voi broad_phase(const Aabb& bone_box_grid, const Aabb& tool_box_tool, const Pose& grid_from_tool,
                double reach_mm) noexcept {
  Voi voi;
  if (bone_box_grid.empty() || tool_box_tool.empty()) return voi;
  const Aabb tool_box = tool_box_tool.grown(reach_mm);
  if (!overlap(Obb::from(bone_box_grid, Pose{}), Obb::from(tool_box, grid_from_tool))) return voi;
  const Aabb bone_in_tool = bone_box_grid.grown(reach_mm).transformed(grid_from_tool.inverse());
  voi.box_tool_mm = tool_box.intersection(bone_in_tool);
  voi.touching = !voi.box_tool_mm.empty();
  return voi;
}

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

Culling::Culling(const voxel::BrickDistance& distance, const voxel::VoxelGrid& grid, const Voi& voi,
                 const QuantisedPose& grid_from_tool) noexcept
    : gap_(distance, grid, grid_from_tool),
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
