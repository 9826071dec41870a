#include <algorithm>

#include "collide/grid_affine.hpp"
#include "collide/narrow_phase.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

constexpr size_t blocks_at_once = 256;
/// Covers the rounding of the centre's coordinates and of the probes' places, voxels.
constexpr float slack_voxels = 1.0f;

/// Four bytes read as one: only signed 32-bit words become gathers.
using Word = int32_t __attribute__((may_alias));

/// What decides about a block, as plain numbers for the inner loop.
struct Culling {
  GridAffine voxel_from_tool;
  float low[3], high[3];  ///< VOI, tool frame, mm
  float limit[3];         ///< grid size, voxels
  int last_brick[3], brick_row, brick_slice;
  float voxels_per_mm;
};

/// keep[i] = 1 for blocks whose sphere meets the VOI and may hold bone. Straight-line arithmetic, so that it
/// vectorizes; what it keeps too much costs time only.
REAM_VECTOR_CLONES void judge(const Culling& shared, const float* __restrict x, const float* __restrict y,
                              const float* __restrict z, const float* __restrict radius,
                              const Word* __restrict distance_words, int n, int32_t* __restrict keep) {
  const Culling c = shared;
  const float edge = voxel::brick_edge;
  const float* m = c.voxel_from_tool.m;
  const float* t = c.voxel_from_tool.t;
  for (int i = 0; i < n; ++i) {
    const float r = radius[i];
    const int in_voi = (x[i] + r >= c.low[0] ? 1 : 0) & (x[i] - r <= c.high[0] ? 1 : 0) &
                       (y[i] + r >= c.low[1] ? 1 : 0) & (y[i] - r <= c.high[1] ? 1 : 0) &
                       (z[i] + r >= c.low[2] ? 1 : 0) & (z[i] - r <= c.high[2] ? 1 : 0);
    const float u = m[0] * x[i] + m[1] * y[i] + m[2] * z[i] + t[0];
    const float v = m[3] * x[i] + m[4] * y[i] + m[5] * z[i] + t[1];
    const float w = m[6] * x[i] + m[7] * y[i] + m[8] * z[i] + t[2];
    const auto within = [](float value, float limit) {
      const float low = value > 0.0f ? value : 0.0f;
      return low < limit ? low : limit;
    };
    const float cu = within(u, c.limit[0]), cv = within(v, c.limit[1]), cw = within(w, c.limit[2]);
    const auto size = [](float d) { return d < 0.0f ? -d : d; };
    float bound = size(u - cu);
    bound = bound > size(v - cv) ? bound : size(v - cv);
    bound = bound > size(w - cw) ? bound : size(w - cw);
    const auto brick = [](float value, int last) {
      const int b = static_cast<int>(value * (1.0f / voxel::brick_edge));
      return b < last ? b : last;
    };
    const int at = brick(cu, c.last_brick[0]) + brick(cv, c.last_brick[1]) * c.brick_row +
                   brick(cw, c.last_brick[2]) * c.brick_slice;
    const int bricks = (distance_words[at >> 2] >> ((at & 3) * 8)) & 0xff;
    const float inside = static_cast<float>(bricks - 1) * edge;
    bound = bound > inside ? bound : inside;
    keep[i] = in_voi & (bound <= r * c.voxels_per_mm + slack_voxels ? 1 : 0);
  }
}

Culling culling(const NarrowPhaseInput& input, const Voi& voi, const QuantisedPose& grid_from_tool) {
  const voxel::VoxelGrid& grid = input.bone.grid;
  const Vec3i bricks = grid.brick_dims();
  Culling c{};
  c.voxel_from_tool = voxel_from_tool(grid_from_tool, grid);
  for (int i = 0; i < 3; ++i) {
    c.low[i] = static_cast<float>(voi.box_tool_mm.min[i]);
    c.high[i] = static_cast<float>(voi.box_tool_mm.max[i]);
    c.limit[i] = static_cast<float>(grid.dims[i]);
    c.last_brick[i] = bricks[i] - 1;
  }
  c.brick_row = bricks.x();
  c.brick_slice = bricks.x() * bricks.y();
  c.voxels_per_mm = static_cast<float>(1.0 / grid.min_spacing_mm());
  return c;
}

}  // namespace

size_t cull_blocks(const NarrowPhaseInput& input, const Voi& voi, const QuantisedPose& grid_from_tool,
                   const VoxelTransform& transform, std::span<SurvivingBlock> survivors) noexcept {
  const ContactShell& shell = input.shell;
  const Culling c = culling(input, voi, grid_from_tool);
  const auto* distance = reinterpret_cast<const Word*>(input.distance.bricks.data());
  size_t count = 0;
  for (size_t first = 0; first < shell.blocks.size(); first += blocks_at_once) {
    int32_t keep[blocks_at_once];
    const size_t n = std::min(blocks_at_once, shell.blocks.size() - first);
    judge(c, shell.centre_x_mm.data() + first, shell.centre_y_mm.data() + first,
          shell.centre_z_mm.data() + first, shell.radius_mm.data() + first, distance, static_cast<int>(n),
          keep);
    for (size_t i = 0; i < n; ++i) {
      survivors[count].block = static_cast<uint32_t>(first + i);
      count += static_cast<size_t>(keep[i]);
    }
  }
  for (size_t i = 0; i < count; ++i)
    survivors[i].base = transform.base(shell.blocks[survivors[i].block].origin_units);
  return count;
}

}  // namespace ream::collide
