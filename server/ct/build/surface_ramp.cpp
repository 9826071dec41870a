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

/// Share of the way to the neighbour at which the surface is crossed; 1 and more: it is not.
double crossing(int here, int neighbour) {
  if ((here > 0) == (neighbour > 0)) return 1.0;
  return static_cast<double>(std::abs(here)) / (std::abs(here) + std::abs(neighbour));
}

struct Rows {
  const std::vector<uint8_t>& coverage;
  std::array<int, 3> dims;
  std::array<size_t, 3> stride;
  std::array<double, 3> edge;  ///< of a voxel, in smallest edges
};

/// To 1/65536, so that a file's rounding of the spacing changes no bit of the bone.
double in_smallest_edges(double edge_mm, double smallest_mm) {
  return std::round(65536.0 * edge_mm / smallest_mm) / 65536.0;
}

uint8_t redrawn(const Rows& rows, size_t at, const std::array<int, 3>& place) {
  const int here = from_half(rows.coverage[at]);
  double inverse_square = 0.0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const size_t step = rows.stride[axis];
    double share = 1.0;
    if (place[axis] > 0) share = crossing(here, from_half(rows.coverage[at - step]));
    if (place[axis] + 1 < rows.dims[axis])
      share = std::min(share, crossing(here, from_half(rows.coverage[at + step])));
    if (share >= 1.0) continue;
    const double distance = share * rows.edge[axis];
    inverse_square += 1.0 / (distance * distance);
  }
  const bool inside = here > 0;
  if (inverse_square == 0.0) return inside ? full : 0;
  const int levels = static_cast<int>(std::min(127.0, std::floor(full / std::sqrt(inverse_square))));
  return static_cast<uint8_t>(inside ? 128 + levels : 127 - levels);
}

}  // namespace

void redraw_surface_ramp(const voxel::VoxelGrid& grid, std::vector<uint8_t>& coverage) {
  const auto nx = static_cast<size_t>(grid.dims.x()), ny = static_cast<size_t>(grid.dims.y());
  std::vector<uint8_t> result(coverage.size());
  const double smallest_mm = grid.min_spacing_mm();
  const Rows rows{coverage,
                  {grid.dims.x(), grid.dims.y(), grid.dims.z()},
                  {1, nx, nx * ny},
                  {in_smallest_edges(grid.spacing_mm.x(), smallest_mm),
                   in_smallest_edges(grid.spacing_mm.y(), smallest_mm),
                   in_smallest_edges(grid.spacing_mm.z(), smallest_mm)}};
  parallel_for(2, static_cast<size_t>(grid.dims.z()), [&](size_t w) {
    size_t at = w * nx * ny;
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u, ++at)
        result[at] = redrawn(rows, at, {u, v, static_cast<int>(w)});
  });
  coverage = std::move(result);
}

}  // namespace ream::ct
