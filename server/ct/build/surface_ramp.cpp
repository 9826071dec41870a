#include "ct/build/surface_ramp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/thread_pool.hpp"

namespace ream::ct {
namespace {

constexpr int full = 255;

/// Twice the distance in coverage from the surface's 127.5, so that it is whole and never 0.
int from_half(int coverage) { return 2 * coverage - full; }

/// Coverage that is nothing, and all, but for noise and soft tissue.
constexpr double plain_share = 0.1;

/// How nearly a neighbour lies beyond the ramp, 0 to 1: there it does not say how steep the ramp is.
double beyond_ramp(int neighbour) {
  const double to_plain = (full - std::abs(neighbour)) / (2.0 * full);
  return std::clamp(1.0 - to_plain / plain_share, 0.0, 1.0);
}

/// How coverage changes from a voxel to the next, twice, by both neighbours. The steeper of both sides has
/// more of the ramp in it; a ramp that lies wholly between both neighbours is as steep as both together.
double slope(int low, int here, int high) {
  const int below = here - low, above = high - here;
  const double steeper = std::max(std::abs(below), std::abs(above));
  if ((below > 0) != (above > 0)) return steeper;
  return steeper + beyond_ramp(low) * beyond_ramp(high) * std::min(std::abs(below), std::abs(above));
}

struct Rows {
  const std::vector<uint8_t>& coverage;
  std::array<int, 3> dims;
  std::array<size_t, 3> stride;
};

uint8_t redrawn(const Rows& rows, double ramp_voxels, size_t at, const std::array<int, 3>& place) {
  const int here = from_half(rows.coverage[at]);
  double steepness_square = 0.0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t step = rows.stride[axis];
    const int low = place[axis] > 0 ? from_half(rows.coverage[at - step]) : here;
    const int high = place[axis] + 1 < rows.dims[axis] ? from_half(rows.coverage[at + step]) : here;
    const double steepness = slope(low, here, high);
    steepness_square += steepness * steepness;
  }
  const bool inside = here > 0;
  const double wide = inside ? std::max(1.0, ramp_voxels) : ramp_voxels;
  const double most = 0.5 * wide * std::sqrt(steepness_square);  // `here` at the end of the ramp
  if (std::abs(here) >= most) return inside ? full : 0;
  const int levels = static_cast<int>(0.5 * full * std::abs(here) / most);
  return static_cast<uint8_t>(inside ? 128 + levels : 127 - levels);
}

}  // namespace

void redraw_surface_ramp(const voxel::VoxelGrid& grid, double ramp_voxels, std::vector<uint8_t>& coverage) {
  const auto nx = static_cast<size_t>(grid.dims.x()), ny = static_cast<size_t>(grid.dims.y());
  std::vector<uint8_t> result(coverage.size());
  const Rows rows{coverage, {grid.dims.x(), grid.dims.y(), grid.dims.z()}, {1, nx, nx * ny}};
  parallel_for(2, static_cast<size_t>(grid.dims.z()), [&](size_t w) {
    size_t at = w * nx * ny;
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u, ++at)
        result[at] = redrawn(rows, ramp_voxels, at, {u, v, static_cast<int>(w)});
  });
  coverage = std::move(result);
}

}  // namespace ream::ct
