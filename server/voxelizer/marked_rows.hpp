#pragma once
#include <cstring>

#include "voxelizer/prepared_triangle.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {

/// What bounds four neighbouring layers of rows, from w on.
struct LayerBounds {
  Double4 u_least, u_most, v_least, v_most, plane;

  void set(const PreparedTriangle& p, int w) {
    const Double4 at_w = static_cast<double>(w) + Double4{0.0, 1.0, 2.0, 3.0};
    u_least = p.u_by_w.most(at_w);
    u_most = p.u_by_w.least(at_w);
    v_least = p.v_by_w.most(at_w);
    v_most = p.v_by_w.least(at_w);
    plane = p.plane.by_w * at_w;
  }
};

/// What bounds neighbouring rows of any layer.
struct RowBounds {
  static constexpr int max_rows = 256;
  double u_least[max_rows + 8], u_most[max_rows + 8], plane[max_rows + 8];

  /// Three rows more than `rows`, which are read with the last four.
  void set(const PreparedTriangle& p, int v, int rows) {
    for (int i = 0; i < rows + 3; i += 8) {
      const Double8 at_v = static_cast<double>(v + i) + Double8{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
      const Double8 least = p.u_by_v.most(at_v), most = p.u_by_v.least(at_v);
      const Double8 middle = p.plane.at + p.plane.by_v * at_v;
      std::memcpy(u_least + i, &least, sizeof least);
      std::memcpy(u_most + i, &most, sizeof most);
      std::memcpy(plane + i, &middle, sizeof middle);
    }
  }
};

inline Double4 four_of(const double* values) {
  Double4 four;
  std::memcpy(&four, values, sizeof four);
  return four;
}

/// Voxels that are marked in rows v to v + 3 of a layer: from `first` to before `end` where `marked` is -1.
struct FourRows {
  int v, w;
  Long4 first, end, marked;
};

/// Calls visit(four rows) for the rows in which a triangle marks voxels, within the rows that it was placed
/// in.
template <class Visit>
inline void for_each_four_rows(const PlacedTriangle& t, const PreparedTriangle& p, const Visit& visit) {
  const Double4 low = Double4{} + static_cast<double>(t.low[0]);
  const Double4 high = Double4{} + static_cast<double>(t.high[0]);
  RowBounds rows;
  LayerBounds layers;
  for (int v = t.low[1]; v <= t.high[1]; v += RowBounds::max_rows) {
    const int last_v = t.high[1] - v < RowBounds::max_rows ? t.high[1] : v + RowBounds::max_rows - 1;
    rows.set(p, v, last_v - v + 1);
    for (int four_w = t.low[2]; four_w <= t.high[2]; four_w += 4) {
      layers.set(p, four_w);
      const Int4 begin = ceil_between(layers.v_least, v, last_v + 1);
      const Int4 end = floor_between(layers.v_most, v - 1, last_v);
      const int count = t.high[2] - four_w < 4 ? t.high[2] - four_w + 1 : 4;
      for (int j = 0; j < count; ++j)
        for (int first = begin[j]; first <= end[j]; first += 4) {
          const Double4 middle = four_of(rows.plane + (first - v)) + layers.plane[j];
          const Double4 least =
              larger(larger(four_of(rows.u_least + (first - v)), Double4{} + layers.u_least[j]),
                     middle - p.plane.width);
          const Double4 most =
              smaller(smaller(four_of(rows.u_most + (first - v)), Double4{} + layers.u_most[j]),
                      middle + p.plane.width);
          FourRows four{first,
                        four_w + j,
                        whole_from(smaller(larger(least, low), high + 1.0)),
                        whole_up_to(smaller(larger(most, low - 1.0), high)) + 1,
                        {}};
          four.marked = (four.first < four.end) & (Long4{0, 1, 2, 3} <= end[j] - first);
          visit(four);
        }
    }
  }
}

/// As for_each_four_rows, one by one: visit(v, w, first u, last u).
template <class Visit>
inline void for_each_marked_row(const PlacedTriangle& t, const PreparedTriangle& p, const Visit& visit) {
  for_each_four_rows(t, p, [&](const FourRows& four) {
    for (int i = 0; i < 4; ++i)
      if (four.marked[i] != 0)
        visit(four.v + i, four.w, static_cast<int>(four.first[i]), static_cast<int>(four.end[i]) - 1);
  });
}

}  // namespace ream::voxelizer
