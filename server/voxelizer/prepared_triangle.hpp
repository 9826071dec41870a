#pragma once
#include "voxelizer/exact_products.hpp"
#include "voxelizer/lanes.hpp"
#include "voxelizer/raster_grid.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {

/// Corners are rounded to 2^-20 voxel, so that differences of corners are exact; boxes are grown by `margin`
/// voxels on each side, more than what that moves a corner and what the tests round. A triangle therefore
/// marks every voxel that it touches and none farther from it than 2^-19 voxel.
inline constexpr double margin = 9.5367431640625e-07;  // 2^-20
/// Adding and subtracting it rounds to 2^-20.
inline constexpr double rounder = 6442450944.0;  // 1.5 * 2^32
inline constexpr double no_bound = 1e30;
/// Least share of the normal that its x component is taken for, so that one form holds for every direction.
inline constexpr double least_share = 5.684341886080802e-14;  // 2^-44
/// Edges shorter than this many voxels have products that are exact anyway.
inline constexpr double short_edge = 32.0;

/// Corners of a triangle in voxels of the grid, and the voxels that its box touches within some rows.
struct PlacedTriangle {
  Double4 at[3];        ///< [axis], a corner a lane; the fourth lane repeats the first
  int low[3], high[3];  ///< inclusive

  /// False when the box touches none of these rows; it may still lie beside the grid in x, where low[0] >
  /// high[0].
  bool place(const TriangleMesh& mesh, size_t triangle, const VoxelMap& map, int dims_x,
             const RowRange& rows) {
    const auto& indices = mesh.triangles[triangle];
    const float* a = mesh.vertices_mm[indices[0]].data();
    const float* b = mesh.vertices_mm[indices[1]].data();
    const float* c = mesh.vertices_mm[indices[2]].data();
    const int first[3] = {0, rows.v_begin, rows.w_begin}, end[3] = {dims_x, rows.v_end, rows.w_end};
    for (int k = 2; k >= 0; --k) {
      const Double4 file = {static_cast<double>(a[k]), static_cast<double>(b[k]), static_cast<double>(c[k]),
                            static_cast<double>(a[k])};
      const auto axis = static_cast<size_t>(k);
      at[k] = ((file * map.factor[axis] + map.offset[axis]) + rounder) - rounder;
      low[k] = ceil_between((least_of_three(at[k]) - 1.0) - margin, first[k], end[k]);
      high[k] = floor_between(most_of_three(at[k]) + margin, first[k] - 1, end[k] - 1);
      if (k > 0 && low[k] > high[k]) return false;
    }
    return true;
  }

  /// Not normalised; each component is exact to one rounding.
  void exact_normal(double normal[3]) const {
    double a[3], b[3];
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      a[k] = at[k][1] - at[k][0];
      b[k] = at[k][2] - at[k][1];
      longest = larger(longest, larger(magnitude(a[k]), magnitude(b[k])));
    }
    const bool is_short = longest < short_edge;
    for (int k = 0; k < 3; ++k) {
      const int i = k == 2 ? 0 : k + 1, j = k == 0 ? 2 : k - 1;
      normal[k] = is_short ? a[i] * b[j] - a[j] * b[i] : difference_of_products(a[i], b[j], a[j], b[i]);
    }
  }
};

/// Bounds of a voxel's index along a row or column of index s, one edge a lane: at least lower + lower_slope
/// * s and at most upper + upper_slope * s. Edges that bound one side only have no bound on the other.
struct EdgeBounds {
  Double4 lower, lower_slope, upper, upper_slope;

  /// By the edges' projections on the plane of x and s (eq. 3.3); `side` says on which side of its edges the
  /// triangle lies.
  void set(const Double4& x, const Double4& s, double side, bool thin) {
    const Long4 next = {1, 2, 0, 1};
    const Double4 ex = __builtin_shuffle(x, next) - x, es = __builtin_shuffle(s, next) - s;
    const Double4 nx = -es * side, ns = ex * side;
    const Double4 mx = magnitude(nx), ms = magnitude(ns), sum = mx + ms;
    const Double4 reach = 0.5 * (thin ? larger(mx, ms) : sum) + margin * sum;  // eqs 3.4, 3.8
    const Double4 inverse = 1.0 / (mx > 0.0 ? nx : Double4{} + 1.0);
    const Double4 slope = -ns * inverse;
    const Double4 base = ((x - 0.5) - reach * inverse) - slope * (s - 0.5);
    const Double4 none = Double4{} + no_bound, flat = {};
    lower = nx > 0.0 ? base : -none;
    lower_slope = nx > 0.0 ? slope : flat;
    upper = nx < 0.0 ? base : none;
    upper_slope = nx < 0.0 ? slope : flat;
  }

  double most(double s) const { return most_of_three(lower + lower_slope * s); }
  double least(double s) const { return least_of_three(upper + upper_slope * s); }

  /// Of eight or four neighbouring rows at once.
  template <class Doubles>
  Doubles most(const Doubles& s) const {
    return larger(larger(lower[0] + lower_slope[0] * s, lower[1] + lower_slope[1] * s),
                  lower[2] + lower_slope[2] * s);
  }
  template <class Doubles>
  Doubles least(const Doubles& s) const {
    return smaller(smaller(upper[0] + upper_slope[0] * s, upper[1] + upper_slope[1] * s),
                   upper[2] + upper_slope[2] * s);
  }
};

/// Eqs 3.2, 3.6, 3.7 solved for u, the plane's bound of a column (Schwarz and Seidel 2010): u within width of
/// at + by_v * v + by_w * w.
struct PlaneBound {
  double at, by_v, by_w, width;

  void set(const PlacedTriangle& t, const double normal[3], bool thin) {
    const double ax = magnitude(normal[0]), ay = magnitude(normal[1]), az = magnitude(normal[2]);
    const double sum = (ax + ay) + az;
    const double reach = 0.5 * (thin ? larger(larger(ax, ay), az) : sum) + margin * sum;
    const bool flat = sum > 0.0;
    const double across = larger(ax, least_share * sum);
    const double inverse = flat ? (normal[0] >= 0.0 ? 1.0 : -1.0) / across : 0.0;
    by_v = -normal[1] * inverse;
    by_w = -normal[2] * inverse;
    width = flat ? reach * magnitude(inverse) : no_bound;
    at = ((t.at[0][0] - 0.5) - by_v * (t.at[1][0] - 0.5)) - by_w * (t.at[2][0] - 0.5);
  }
};

/// Everything that the separating-axis test of thesis section 3.4 asks of a row of voxels, solved for u: the
/// voxels of a row that a triangle marks are the whole numbers between the largest lower and the smallest
/// upper bound.
struct PreparedTriangle {
  EdgeBounds u_by_v, u_by_w, v_by_w;
  PlaneBound plane;

  void prepare(const PlacedTriangle& t, bool thin) {
    double n[3];
    t.exact_normal(n);
    u_by_v.set(t.at[0], t.at[1], n[2] >= 0.0 ? 1.0 : -1.0, thin);
    u_by_w.set(t.at[0], t.at[2], n[1] <= 0.0 ? 1.0 : -1.0, thin);
    v_by_w.set(t.at[1], t.at[2], n[0] >= 0.0 ? 1.0 : -1.0, thin);
    plane.set(t, n, thin);
  }
};

}  // namespace ream::voxelizer
