#pragma once
#include <cstdint>
#include <vector>

#include "collide/grid_affine.hpp"
#include "shell/swept_profile.hpp"

namespace ream::collide {

/// The swept profile's table in 16-bit steps, so that one load brings two neighbours. Table coordinates are
/// clamped: the table's margin is wider than half a voxel, so its border keeps everything. The order of
/// operations is that of kernels/removal.cl.
struct ProfileTable {
  /// Distances at r2 cells i (low half) and i + 1 (high half), in steps; [z][r2], r2 fastest.
  std::vector<int32_t> pairs;
  int r2_count = 0;
  float z_min_mm = 0, inverse_z_step = 0, inverse_r2_step = 0;
  float r2_limit = 0, z_limit = 0;  ///< last usable table coordinates
  float levels_per_step = 0;        ///< coverage levels (255 a voxel edge) in one step of distance
};

/// `levels_per_mm` as coverage_levels_per_mm() gives it. A step is a power of two, at most 1/16000 of the
/// profile's margin; distances beyond the margin count as far.
ProfileTable profile_table(const shell::SweptProfile& profile, float levels_per_mm);

/// Levels (kept_coverage() of removal.hpp) of the 512 voxels of the brick whose minimum voxel is `first`, x
/// fastest: 128 plus the signed distance of the voxel centre in levels.
void brick_levels(const ProfileTable& table, const GridAffine& tool_from_voxel, const Vec3i& first,
                  float* levels) noexcept;

}  // namespace ream::collide
