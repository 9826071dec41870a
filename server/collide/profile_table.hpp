#pragma once
#include "collide/grid_affine.hpp"
#include "shell/swept_profile.hpp"

namespace ream::collide {

/// The swept profile's table as plain values for inner loops. Table coordinates are clamped: the table's
/// margin is wider than half a voxel, so its border keeps everything. The order of operations is that of
/// kernels/removal.cl.
struct ProfileTable {
  const float* distance_mm;
  int r2_count;
  float z_min_mm, inverse_z_step, inverse_r2_step;
  float r2_limit, z_limit;  ///< last usable table coordinates

  explicit ProfileTable(const shell::SweptProfile& profile)
      : distance_mm(profile.distance_mm.data()),
        r2_count(profile.r2_count),
        z_min_mm(profile.z_min_mm),
        inverse_z_step(profile.inverse_z_step),
        inverse_r2_step(profile.inverse_r2_step),
        r2_limit(static_cast<float>(profile.r2_count) - 1.5f),
        z_limit(static_cast<float>(profile.z_count) - 1.5f) {}
};

/// kept_level() of the 512 voxels of the brick whose minimum voxel is `first`, x fastest.
void brick_levels(const ProfileTable& table, const GridAffine& tool_from_voxel, float levels_per_mm,
                  const Vec3i& first, float* levels) noexcept;

}  // namespace ream::collide
