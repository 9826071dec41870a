#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/block_mesh.hpp"

namespace ream::surface {

/// Coverage of a voxel before anything was cut, and now.
struct TwoCoverages {
  int before = 0, now = 0;
};

/// How far a place on the present surface lies under the first one, 0 to `max_level` at half a voxel and
/// more; 0 where no bone is gone. Trilinear between voxel centres, in whole numbers. Depth changes evenly
/// over the edge of a cut; that bone is gone there says that it was cut. `at_units`: 1/1024 voxel from the
/// grid's minimum corner. `sample(voxel)`: TwoCoverages, none outside the grid.
template <typename Sample>
int removed_level(const std::array<int64_t, 3>& at_units, int max_level, Sample&& sample) {
  constexpr int64_t unit = units_per_voxel, one = unit * unit * unit;
  // What is lost where a surface has gone half a voxel further in: from full to the surface's level.
  constexpr int64_t whole_loss = 127;
  Vec3i low;
  int64_t share[3][2];
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t from_centre = at_units[static_cast<size_t>(axis)] - unit / 2;
    const int64_t voxels = from_centre >= 0 ? from_centre / unit : -((unit - 1 - from_centre) / unit);
    low[axis] = static_cast<int>(voxels);
    share[axis][1] = from_centre - voxels * unit;
    share[axis][0] = unit - share[axis][1];
  }
  int64_t before = 0, lost = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const TwoCoverages coverage = sample(Vec3i(low + Vec3i(x, y, z)));
    const int64_t weight = share[0][x] * share[1][y] * share[2][z];
    before += weight * coverage.before;
    lost += weight * std::max(0, coverage.before - coverage.now);
  }
  const int64_t depth = before - one * 255 / 2;
  return static_cast<int>(
      std::clamp<int64_t>(max_level * std::min(depth, lost) / (one * whole_loss), 0, max_level));
}

/// Where so much of half a voxel is gone the bone is painted as cut, on pictures and on the page. (What is
/// compared with a plan is any voxel that has lost something: score::cut_vertices.)
inline constexpr float cut_share = 0.3f;

/// removed_level of points of a surface, 0 to 1 each: grid frame, mm. `before` and `now` have
/// grid.voxel_count() bytes in the order of VoxelGrid::index.
std::vector<float> removed_shares(std::span<const Vec3f> points_mm, const voxel::VoxelGrid& grid,
                                  const uint8_t* before, const uint8_t* now);

}  // namespace ream::surface
