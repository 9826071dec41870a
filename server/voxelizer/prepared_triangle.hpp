#pragma once
#include "voxelizer/placed_triangle.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits. A Real is one
// triangle's double or, a triangle a lane, a vector of them.
namespace ream::voxelizer {

inline constexpr double no_bound = 1e30;
/// Least share of the normal that its x component is taken for, so that one form holds for every direction.
inline constexpr double least_share = 5.684341886080802e-14;  // 2^-44

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
    const Real across = sum > 0.0 ? larger(ax, least_share * sum) : Real{} + 1.0;
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
