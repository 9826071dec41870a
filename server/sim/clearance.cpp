#include "sim/clearance.hpp"

#include <algorithm>

namespace ream::sim {
namespace {

/// Probes reach beyond the spheres of their blocks by at most this much; some of it is for rounding.
constexpr float slack_voxels = 2.5f;

}  // namespace

double clearance_mm(const Model& model, State& state) noexcept {
  const auto& blocks = model.contact_shell.blocks;
  if (blocks.empty()) return 0.0;
  const voxel::VoxelGrid& grid = state.bone.grid;
  const QuantisedPose pose = quantised(grid.world_from_grid.inverse() * state.world_from_tool);
  const collide::GridAffine a = collide::voxel_from_tool(pose, grid);
  const float voxels_per_mm = static_cast<float>(1.0 / grid.min_spacing_mm());
  float nearest = 1.0e6f;
  // The block that was nearest last time comes first: beside bone it alone answers.
  const size_t first = state.nearest_block;
  for (size_t i = 0; i < blocks.size() && nearest > 1.0f; ++i) {
    const size_t b = first + i < blocks.size() ? first + i : first + i - blocks.size();
    const Vec3f& c = blocks[b].centre_mm;
    const float u = a.m[0] * c.x() + a.m[1] * c.y() + a.m[2] * c.z() + a.t[0];
    const float v = a.m[3] * c.x() + a.m[4] * c.y() + a.m[5] * c.z() + a.t[1];
    const float w = a.m[6] * c.x() + a.m[7] * c.y() + a.m[8] * c.z() + a.t[2];
    const float gap = model.distance.lower_bound_voxels(u, v, w) - blocks[b].radius_mm * voxels_per_mm;
    if (gap >= nearest) continue;
    nearest = gap;
    state.nearest_block = b;
  }
  return std::max(0.0, static_cast<double>(nearest - slack_voxels)) * grid.min_spacing_mm();
}

}  // namespace ream::sim
