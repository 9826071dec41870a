#include "sim/clearance.hpp"

#include <algorithm>

#include "collide/grid_affine.hpp"

namespace ream::sim {
namespace {

/// Covers the rounding of the spheres' places.
constexpr float slack_voxels = 1.5f;

}  // namespace

double clearance_mm(const Model& model, State& state) noexcept {
  const collide::ContactShell& shell = model.contact_shell;
  const size_t blocks = shell.blocks.size();
  const voxel::VoxelGrid& grid = state.bone.grid;
  const QuantisedPose pose = quantised(grid.world_from_grid.inverse() * state.world_from_tool);
  const collide::GridAffine a = collide::voxel_from_tool(pose, grid);
  const float voxels_per_mm = static_cast<float>(1.0 / grid.min_spacing_mm());
  float nearest = 1.0e6f;
  // The block that was nearest last time comes first: beside bone it alone answers.
  const size_t first = state.nearest_block;
  for (size_t i = 0; i < blocks && nearest > slack_voxels; ++i) {
    const size_t b = first + i < blocks ? first + i : first + i - blocks;
    const float x = shell.centre_x_mm[b], y = shell.centre_y_mm[b], z = shell.centre_z_mm[b];
    const float u = a.m[0] * x + a.m[1] * y + a.m[2] * z + a.t[0];
    const float v = a.m[3] * x + a.m[4] * y + a.m[5] * z + a.t[1];
    const float w = a.m[6] * x + a.m[7] * y + a.m[8] * z + a.t[2];
    const float gap = model.distance.lower_bound_voxels(u, v, w) - shell.radius_mm[b] * voxels_per_mm;
    if (gap >= nearest) continue;
    nearest = gap;
    state.nearest_block = b;
  }
  return std::max(0.0, static_cast<double>(nearest - slack_voxels)) * grid.min_spacing_mm();
}

}  // namespace ream::sim
