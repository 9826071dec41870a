#include "voxelizer/prepared_triangle.hpp"

#include "voxelizer/bounds.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {
namespace {

/// Adding and subtracting it rounds to 2^-20.
constexpr double rounder = 6442450944.0;  // 1.5 * 2^32
constexpr double no_bound = 1e30;
/// Least share of the normal that its x component is taken for, so that one form holds for every direction.
constexpr double least_share = 5.684341886080802e-14;  // 2^-44
/// Edges shorter than this many voxels have products that are exact anyway.
constexpr double short_edge = 32.0;

struct Product {
  double value, error;
};

Product exact_product(double a, double b) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double sa = splitter * a, sb = splitter * b;
  const double ah = sa - (sa - a), bh = sb - (sb - b);
  const double al = a - ah, bl = b - bh;
  const double value = a * b;
  return {value, ((ah * bh - value) + ah * bl + al * bh) + al * bl};
}

/// Bound i by the edge from (ax, as) along (ex, es); `side` says on which side of it the triangle lies.
inline void set_bound(EdgeBounds& bounds, int i, double ax, double as, double ex, double es, double side,
                      bool thin) {
  const double nx = -es * side, ns = ex * side;  // eq. 3.3
  const double mx = magnitude(nx), ms = magnitude(ns), sum = mx + ms;
  const double reach = 0.5 * (thin ? larger(mx, ms) : sum) + margin * sum;  // eqs 3.4, 3.8
  const double inverse = 1.0 / (mx > 0.0 ? nx : 1.0);
  const double slope = -ns * inverse;
  const double base = ((ax - 0.5) - reach * inverse) - slope * (as - 0.5);
  const bool is_lower = nx > 0.0, is_upper = nx < 0.0;
  bounds.lower[i] = is_lower ? base : -no_bound;
  bounds.lower_slope[i] = is_lower ? slope : 0.0;
  bounds.upper[i] = is_upper ? base : no_bound;
  bounds.upper_slope[i] = is_upper ? slope : 0.0;
}

}  // namespace

double difference_of_products(double a, double b, double c, double d) {
  const Product p = exact_product(a, b), q = exact_product(c, d);
  return (p.value - q.value) + (p.error - q.error);
}

bool PlacedTriangle::place(const TriangleMesh& mesh, size_t triangle, const VoxelMap& map, int dims_x,
                           const RowRange& rows) {
  const auto& indices = mesh.triangles[triangle];
  for (size_t i = 0; i < 3; ++i) {
    const float* vertex = mesh.vertices_mm[indices[i]].data();
    for (size_t k = 0; k < 3; ++k) {
      const double exact = static_cast<double>(vertex[k]) * map.factor[k] + map.offset[k];
      corner[i][k] = (exact + rounder) - rounder;
    }
  }
  const int first[3] = {0, rows.v_begin, rows.w_begin}, end[3] = {dims_x, rows.v_end, rows.w_end};
  for (int k = 0; k < 3; ++k) {
    const double least = smaller(smaller(corner[0][k], corner[1][k]), corner[2][k]);
    const double most = larger(larger(corner[0][k], corner[1][k]), corner[2][k]);
    low[k] = ceil_between((least - 1.0) - margin, first[k], end[k]);
    high[k] = floor_between(most + margin, first[k] - 1, end[k] - 1);
  }
  return low[1] <= high[1] && low[2] <= high[2];
}

void exact_normal(const PlacedTriangle& t, double normal[3]) {
  double a[3], b[3];
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    a[k] = t.corner[1][k] - t.corner[0][k];
    b[k] = t.corner[2][k] - t.corner[1][k];
    longest = larger(longest, larger(magnitude(a[k]), magnitude(b[k])));
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    normal[k] =
        longest < short_edge ? a[i] * b[j] - a[j] * b[i] : difference_of_products(a[i], b[j], a[j], b[i]);
  }
}

void PreparedTriangle::prepare(const PlacedTriangle& t, bool thin) {
  double normal[3];
  exact_normal(t, normal);
  set_edges(t, normal, thin);
  set_plane(t, normal, thin);
}

void PreparedTriangle::prepare_plane(const PlacedTriangle& t) {
  double normal[3];
  exact_normal(t, normal);
  set_plane(t, normal, false);
}

void PreparedTriangle::set_edges(const PlacedTriangle& t, const double n[3], bool thin) {
  const double side_xy = n[2] >= 0.0 ? 1.0 : -1.0;
  const double side_xz = n[1] <= 0.0 ? 1.0 : -1.0;
  const double side_yz = n[0] >= 0.0 ? 1.0 : -1.0;
  for (int i = 0; i < 3; ++i) {
    const double* from = t.corner[i];
    const double* to = t.corner[(i + 1) % 3];
    const double ex = to[0] - from[0], ey = to[1] - from[1], ez = to[2] - from[2];
    set_bound(u_by_v, i, from[0], from[1], ex, ey, side_xy, thin);
    set_bound(u_by_w, i, from[0], from[2], ex, ez, side_xz, thin);
    set_bound(v_by_w, i, from[1], from[2], ey, ez, side_yz, thin);
  }
}

void PreparedTriangle::set_plane(const PlacedTriangle& t, const double n[3], bool thin) {
  const double ax = magnitude(n[0]), ay = magnitude(n[1]), az = magnitude(n[2]);
  const double sum = (ax + ay) + az;
  const double reach = 0.5 * (thin ? larger(larger(ax, ay), az) : sum) + margin * sum;
  const bool flat = sum > 0.0;
  const double across = larger(ax, least_share * sum);
  const double inverse = flat ? (n[0] >= 0.0 ? 1.0 : -1.0) / across : 0.0;
  plane_by_v = -n[1] * inverse;
  plane_by_w = -n[2] * inverse;
  plane_width = flat ? reach * magnitude(inverse) : no_bound;
  plane =
      ((t.corner[0][0] - 0.5) - plane_by_v * (t.corner[0][1] - 0.5)) - plane_by_w * (t.corner[0][2] - 0.5);
}

}  // namespace ream::voxelizer
