#pragma once
#include "voxelizer/prepared_triangle.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {

/// Neighbouring rows v, v + 1, ... of all layers of the triangle's box.
template <class Doubles, class Visit>
inline void visit_strip(const PlacedTriangle& t, const PreparedTriangle& p, int v, const Visit& visit) {
  constexpr int lanes = static_cast<int>(sizeof(Doubles) / sizeof(double));
  using Whole = typename WholeOf<Doubles>::Type;
  Doubles s{};
  for (int i = 0; i < lanes; ++i) s[i] = static_cast<double>(v + i);
  const Doubles strip_lower = p.u_by_v.most(s), strip_upper = p.u_by_v.least(s);
  const Doubles strip_plane = p.plane.at + p.plane.by_v * s;
  const int last_v = v + lanes - 1 < t.high[1] ? v + lanes - 1 : t.high[1];
  const double low = static_cast<double>(t.low[0]), high = static_cast<double>(t.high[0]);
  for (int w = t.low[2]; w <= t.high[2]; ++w) {
    const double at_w = static_cast<double>(w);
    const int begin = ceil_between(p.v_by_w.most(at_w), v, last_v + 1);
    const int end = floor_between(p.v_by_w.least(at_w), v - 1, last_v);
    if (begin > end) continue;
    const Doubles middle = strip_plane + p.plane.by_w * at_w;
    const Doubles least =
        larger(larger(strip_lower, Doubles{} + p.u_by_w.most(at_w)), middle - p.plane.width);
    const Doubles most =
        smaller(smaller(strip_upper, Doubles{} + p.u_by_w.least(at_w)), middle + p.plane.width);
    const Whole from = ceil_between(least, low, high + 1.0), to = floor_between(most, low - 1.0, high);
    for (int i = begin - v; i <= end - v; ++i)
      if (from[i] <= to[i]) visit(v + i, w, from[i], to[i]);
  }
}

/// Calls visit(v, w, first u, last u) for the rows in which a triangle marks voxels, within the rows that it
/// was placed in: four or eight rows at a time.
template <class Visit>
inline void for_each_marked_row(const PlacedTriangle& t, const PreparedTriangle& p, const Visit& visit) {
  if (t.high[1] - t.low[1] < 4) {
    visit_strip<Double4>(t, p, t.low[1], visit);
    return;
  }
  for (int v = t.low[1]; v <= t.high[1]; v += 8) visit_strip<Double8>(t, p, v, visit);
}

}  // namespace ream::voxelizer
