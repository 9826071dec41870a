#include "sim/clearance.hpp"

#include <algorithm>

#include "collide/cull_blocks.hpp"

namespace ream::sim {
namespace {

/// Covers the rounding of the spheres' places.
constexpr float slack_voxels = 1.5f;

}  // namespace

double clearance_mm(const Model& model, State& state) noexcept {
  const collide::ContactShell& shell = model.contact_shell;
  const size_t blocks = shell.blocks.size();
  const voxel::VoxelGrid& grid = state.bone.grid;
  const QuantisedPose pose = quantised(state.world_from_grid.inverse() * state.world_from_tool);
  const collide::BoneGap bone_gap(model.distance, grid, pose);
  float nearest = 1.0e6f;
  // The block that was nearest last time comes first: beside bone it alone answers.
  const size_t first = state.nearest_block;
  for (size_t i = 0; i < blocks && nearest > slack_voxels; ++i) {
    const size_t b = first + i < blocks ? first + i : first + i - blocks;
    const float gap = bone_gap.voxels(shell, static_cast<uint32_t>(b));
    if (gap >= nearest) continue;
    nearest = gap;
    state.nearest_block = b;
  }
  return std::max(0.0, static_cast<double>(nearest - slack_voxels)) * grid.min_spacing_mm();
}

}  // namespace ream::sim
