#pragma once
#include "voxelizer/exact_products.hpp"
#include "voxelizer/lanes.hpp"
#include "voxelizer/raster_grid.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits. A Real is one
// triangle's double or, a triangle a lane, a vector of them.
namespace ream::voxelizer {

/// Corners are rounded to 2^-20 voxel, so that differences of corners are exact; boxes are grown by `margin`
/// voxels on each side, more than what that moves a corner and what the tests round. A triangle therefore
/// marks every voxel that it touches and none farther from it than 2^-19 voxel.
inline constexpr double margin = 9.5367431640625e-07;  // 2^-20
/// Adding and subtracting it rounds to 2^-20.
inline constexpr double rounder = 6442450944.0;  // 1.5 * 2^32
/// Edges shorter than this many voxels have products that are exact anyway.
inline constexpr double short_edge = 32.0;

template <class Real>
inline Real largest(const Real of[3]) {
  return larger(larger(of[0], of[1]), of[2]);
}
template <class Real>
inline Real smallest(const Real of[3]) {
  return smaller(smaller(of[0], of[1]), of[2]);
}

/// Corners of a triangle in voxels of the grid, and the voxels that its box touches within some rows.
template <class Real>
struct Placed {
  using Whole = typename WholeOf<Real>::Type;
  Real at[3][3];          ///< [axis][corner]
  Whole low[3], high[3];  ///< inclusive; low > high on an axis: none

  /// `file`: corners in the mesh's own coordinates, [axis][corner].
  void place(const Real file[3][3], const VoxelMap& map, int dims_x, const RowRange& rows) {
    const int first[3] = {0, rows.v_begin, rows.w_begin}, end[3] = {dims_x, rows.v_end, rows.w_end};
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<size_t>(k);
      for (int i = 0; i < 3; ++i)
        at[k][i] = ((file[k][i] * map.factor[axis] + map.offset[axis]) + rounder) - rounder;
      low[k] = ceil_between((smallest(at[k]) - 1.0) - margin, first[k], end[k]);
      high[k] = floor_between(largest(at[k]) + margin, first[k] - 1, end[k] - 1);
    }
  }

  /// Not normalised; each component is exact to one rounding.
  void exact_normal(Real normal[3]) const {
    Real a[3], b[3];
    Real longest{};
    for (int k = 0; k < 3; ++k) {
      a[k] = at[k][1] - at[k][0];
      b[k] = at[k][2] - at[k][1];
      longest = larger(longest, larger(magnitude(a[k]), magnitude(b[k])));
    }
    const bool is_short = all_below(longest, short_edge);
    for (int k = 0; k < 3; ++k) {
      const int i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
      normal[k] = is_short ? a[i] * b[j] - a[j] * b[i] : difference_of_products(a[i], b[j], a[j], b[i]);
    }
  }
};

struct PlacedTriangle : Placed<double> {
  /// False when the box touches none of these rows; it may still lie beside the grid in x.
  bool place(const TriangleMesh& mesh, size_t triangle, const VoxelMap& map, int dims_x,
             const RowRange& rows) {
    const auto& indices = mesh.triangles[triangle];
    double file[3][3];
    for (int i = 0; i < 3; ++i) {
      const float* corner = mesh.vertices_mm[indices[static_cast<size_t>(i)]].data();
      for (int k = 0; k < 3; ++k) file[k][i] = static_cast<double>(corner[k]);
    }
    Placed::place(file, map, dims_x, rows);
    return low[1] <= high[1] && low[2] <= high[2];
  }
};

}  // namespace ream::voxelizer
