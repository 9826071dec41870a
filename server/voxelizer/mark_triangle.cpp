#include "voxelizer/mark_triangle.hpp"

#include "core/vector_clones.hpp"
#include "voxelizer/prepared_triangle.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {
namespace {

/// Sets bits low to high of a row.
inline void set_bits(uint32_t* row, int low, int high) {
  const int first = low >> 5, last = high >> 5;
  const uint32_t from = ~0u << (low & 31), to = ~0u >> (31 - (high & 31));
  if (first == last) {
    row[first] |= from & to;
    return;
  }
  row[first] |= from;
  for (int i = first + 1; i < last; ++i) row[i] = ~0u;
  row[last] |= to;
}

/// Neighbouring rows v, v + 1, ... of all layers of the triangle's box.
template <class Doubles>
inline void mark_strip(const PlacedTriangle& t, const PreparedTriangle& p, int v, const TileRows& tile) {
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
    uint32_t* row = tile.row(begin, w);
    for (int i = begin - v; i <= end - v; ++i, row += tile.words_per_row)
      if (from[i] <= to[i]) set_bits(row, from[i], to[i]);
  }
}

inline void mark_triangle(const PlacedTriangle& t, const PreparedTriangle& p, const TileRows& tile) {
  if (t.high[1] - t.low[1] < 4) {
    mark_strip<Double4>(t, p, t.low[1], tile);
    return;
  }
  for (int v = t.low[1]; v <= t.high[1]; v += 8) mark_strip<Double8>(t, p, v, tile);
}

REAM_VECTOR_CLONES __attribute__((flatten)) void mark_all(const SurfaceMarker& marker, size_t tile_number,
                                                          int dims_x, const TileRows& tile) {
  const bool thin = marker.separability == Separability::six;
  marker.bins.for_each(tile_number, [&](size_t triangle) {
    PlacedTriangle placed;
    if (!placed.place(marker.mesh, triangle, marker.map, dims_x, tile.range)) return;
    if (placed.low[0] > placed.high[0]) return;
    PreparedTriangle prepared;
    prepared.prepare(placed, thin);
    mark_triangle(placed, prepared, tile);
  });
}

}  // namespace

void SurfaceMarker::mark(size_t tile_number, int dims_x, const TileRows& tile) const {
  mark_all(*this, tile_number, dims_x, tile);
}

}  // namespace ream::voxelizer
