#pragma once
#include "voxelizer/lanes.hpp"
#include "voxelizer/raster_grid.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits. A Real is one
// triangle's double or, a triangle a lane, a vector of them.
namespace ream::voxelizer {

/// a*b - c*d as if rounded once, for values whose products do not overflow: Dekker's exact products.
template <class Real>
__attribute__((always_inline)) inline Real difference_of_products(const Real& a, const Real& b, const Real& c,
                                                                  const Real& d) {
  struct Product {
    Real value, error;
  };
  const auto exact = [](const Real& p, const Real& q) {
    constexpr double splitter = 134217729.0;  // 2^27 + 1
    const Real sp = splitter * p, sq = splitter * q;
    const Real ph = sp - (sp - p), qh = sq - (sq - q);
    const Real pl = p - ph, ql = q - qh;
    const Real value = p * q;
    return Product{value, ((ph * qh - value) + ph * ql + pl * qh) + pl * ql};
  };
  const Product p = exact(a, b), q = exact(c, d);
  return (p.value - q.value) + (p.error - q.error);
}

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

inline constexpr double no_bound = 1e30;
/// Least share of the normal that its x component is taken for, so that one form holds for every direction.
inline constexpr double min_share = 5.684341886080802e-14;  // 2^-44

/// Bounds of a voxel's index along a row or column of index s, edge by edge: at least lower + slope * s and
/// at most upper + slope * s. What bounds one side only has no bound on the other.
template <class Real>
struct EdgeBounds {
  Real lower[3], upper[3], slope[3];

  /// By the edges' projections on the plane of x and s (eq. 3.3); `side` says on which side of its edges the
  /// triangle lies.
  void set(const Real x[3], const Real s[3], const Real& side, bool thin) {
    for (int i = 0; i < 3; ++i) {
      const int next = i == 2 ? 0 : i + 1;
      const Real ex = x[next] - x[i], es = s[next] - s[i];
      const Real nx = -es * side, ns = ex * side;
      const Real mx = magnitude(nx), ms = magnitude(ns), sum = mx + ms;
      const Real reach = 0.5 * (thin ? larger(mx, ms) : sum) + margin * sum;  // eqs 3.4, 3.8
      const Real inverse = 1.0 / (mx > 0.0 ? nx : Real{} + 1.0);
      slope[i] = -ns * inverse;
      const Real base = ((x[i] - 0.5) - reach * inverse) - slope[i] * (s[i] - 0.5);
      lower[i] = nx > 0.0 ? base : Real{} - no_bound;
      upper[i] = nx < 0.0 ? base : Real{} + no_bound;
    }
  }

  /// Of one triangle, along one or several rows.
  template <class Doubles>
  Doubles most(const Doubles& s) const {
    return larger(larger(lower[0] + slope[0] * s, lower[1] + slope[1] * s), lower[2] + slope[2] * s);
  }
  template <class Doubles>
  Doubles least(const Doubles& s) const {
    return smaller(smaller(upper[0] + slope[0] * s, upper[1] + slope[1] * s), upper[2] + slope[2] * s);
  }
};

/// Eqs 3.2, 3.6, 3.7 solved for u, the plane's bound of a column (Schwarz and Seidel 2010): u within width of
/// at + by_v * v + by_w * w.
template <class Real>
struct PlaneBound {
  Real at, by_v, by_w, width;

  void set(const Placed<Real>& t, const Real normal[3], bool thin) {
    const Real ax = magnitude(normal[0]), ay = magnitude(normal[1]), az = magnitude(normal[2]);
    const Real sum = (ax + ay) + az;
    const Real reach = 0.5 * (thin ? larger(larger(ax, ay), az) : sum) + margin * sum;
    const Real across = sum > 0.0 ? larger(ax, min_share * sum) : Real{} + 1.0;
    const Real side = normal[0] >= 0.0 ? Real{} + 1.0 : Real{} - 1.0;
    const Real inverse = sum > 0.0 ? side / across : Real{};
    by_v = -normal[1] * inverse;
    by_w = -normal[2] * inverse;
    width = sum > 0.0 ? reach * magnitude(inverse) : Real{} + no_bound;
    at = ((t.at[0][0] - 0.5) - by_v * (t.at[1][0] - 0.5)) - by_w * (t.at[2][0] - 0.5);
  }
};

/// Everything that the separating-axis test of thesis section 3.4 asks of a row of voxels, solved for u: the
/// voxels of a row that a triangle marks are the whole numbers between the largest lower and the smallest
/// upper bound.
template <class Real>
struct Prepared {
  EdgeBounds<Real> u_by_v, u_by_w, v_by_w;
  PlaneBound<Real> plane;

  void prepare(const Placed<Real>& t, bool thin) {
    const Real one = Real{} + 1.0;
    Real n[3];
    t.exact_normal(n);
    u_by_v.set(t.at[0], t.at[1], n[2] >= 0.0 ? one : -one, thin);
    u_by_w.set(t.at[0], t.at[2], n[1] <= 0.0 ? one : -one, thin);
    v_by_w.set(t.at[1], t.at[2], n[0] >= 0.0 ? one : -one, thin);
    plane.set(t, n, thin);
  }
};
using PreparedTriangle = Prepared<double>;

}  // namespace ream::voxelizer
