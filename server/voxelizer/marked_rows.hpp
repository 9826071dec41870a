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
  static constexpr int most_rows = 256;
  Double8 u_least[most_rows / 8 + 1], u_most[most_rows / 8 + 1], plane[most_rows / 8 + 1];

  void set(const PreparedTriangle& p, int v, int rows) {
    for (int i = 0; i < rows; i += 8) {
      const Double8 at_v = static_cast<double>(v + i) + Double8{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
      u_least[i / 8] = p.u_by_v.most(at_v);
      u_most[i / 8] = p.u_by_v.least(at_v);
      plane[i / 8] = p.plane.at + p.plane.by_v * at_v;
    }
  }
  /// Of eight rows from the given one on.
  static Double8 eight(const Double8* values, int row) {
    Double8 of;
    std::memcpy(&of, reinterpret_cast<const char*>(values) + sizeof(double) * static_cast<size_t>(row), sizeof of);
    return of;
  }
};

/// Calls visit(v, w, first u, last u) for the rows in which a triangle marks voxels, within the rows that it
/// was placed in.
template <class Visit>
inline void for_each_marked_row(const PlacedTriangle& t, const PreparedTriangle& p, const Visit& visit) {
  const double low = static_cast<double>(t.low[0]), high = static_cast<double>(t.high[0]);
  RowBounds rows;
  LayerBounds layers;
  for (int v = t.low[1]; v <= t.high[1]; v += RowBounds::most_rows) {
    const int last_v = t.high[1] - v < RowBounds::most_rows ? t.high[1] : v + RowBounds::most_rows - 1;
    rows.set(p, v, last_v - v + 1);
    for (int w = t.low[2]; w <= t.high[2]; ++w) {
      const int layer = (w - t.low[2]) % 4;
      if (layer == 0) layers.set(p, w);
      const int begin = ceil_between(layers.v_least[layer], v, last_v + 1);
      const int end = floor_between(layers.v_most[layer], v - 1, last_v);
      for (int first = begin; first <= end; first += 8) {
        const Double8 middle = RowBounds::eight(rows.plane, first - v) + layers.plane[layer];
        const Double8 u_least = Double8{} + layers.u_least[layer], u_most = Double8{} + layers.u_most[layer];
        const Double8 least = larger(larger(RowBounds::eight(rows.u_least, first - v), u_least), middle - p.plane.width);
        const Double8 most = smaller(smaller(RowBounds::eight(rows.u_most, first - v), u_most), middle + p.plane.width);
        const Int8 from = ceil_between(least, low, high + 1.0), to = floor_between(most, low - 1.0, high);
        const int count = end - first < 8 ? end - first + 1 : 8;
        for (int i = 0; i < count; ++i)
          if (from[i] <= to[i]) visit(first + i, w, from[i], to[i]);
      }
    }
  }
}

}  // namespace ream::voxelizer
