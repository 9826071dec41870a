#include "voxelizer/mark_triangle.hpp"

#include "core/vector_clones.hpp"
#include "voxelizer/bounds.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {
namespace {

constexpr int lanes = 8;

double most_of(const EdgeBounds& b, double s) {
  return larger(larger(b.lower[0] + b.lower_slope[0] * s, b.lower[1] + b.lower_slope[1] * s),
                b.lower[2] + b.lower_slope[2] * s);
}
double least_of(const EdgeBounds& b, double s) {
  return smaller(smaller(b.upper[0] + b.upper_slope[0] * s, b.upper[1] + b.upper_slope[1] * s),
                 b.upper[2] + b.upper_slope[2] * s);
}

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

/// What eight neighbouring rows of all layers share.
struct Strip {
  double lower[lanes], upper[lanes], plane[lanes];
};

inline void prepare_strip(const PreparedTriangle& p, int v, Strip& strip) {
  for (int i = 0; i < lanes; ++i) {
    const double s = static_cast<double>(v + i);
    strip.lower[i] = most_of(p.u_by_v, s);
    strip.upper[i] = least_of(p.u_by_v, s);
    strip.plane[i] = p.plane + p.plane_by_v * s;
  }
}

}  // namespace

REAM_VECTOR_CLONES void mark_triangle(const PlacedTriangle& t, const PreparedTriangle& p,
                                      const TileRows& tile) {
  const int low = t.low[0], high = t.high[0];
  for (int v = t.low[1]; v <= t.high[1]; v += lanes) {
    Strip strip;
    prepare_strip(p, v, strip);
    for (int w = t.low[2]; w <= t.high[2]; ++w) {
      const double s = static_cast<double>(w);
      const int last_v = v + lanes - 1 < t.high[1] ? v + lanes - 1 : t.high[1];
      const int begin = ceil_between(most_of(p.v_by_w, s), v, last_v + 1);
      const int end = floor_between(least_of(p.v_by_w, s), v - 1, last_v);
      if (begin > end) continue;
      const double lower = most_of(p.u_by_w, s), upper = least_of(p.u_by_w, s), plane = p.plane_by_w * s;
      int from[lanes], to[lanes];
      for (int i = 0; i < lanes; ++i) {
        const double middle = strip.plane[i] + plane;
        const double least = larger(larger(strip.lower[i], lower), middle - p.plane_width);
        const double most = smaller(smaller(strip.upper[i], upper), middle + p.plane_width);
        from[i] = ceil_between(least, low, high + 1);
        to[i] = floor_between(most, low - 1, high);
      }
      for (int row = begin; row <= end; ++row)
        if (from[row - v] <= to[row - v]) set_bits(tile.row(row, w), from[row - v], to[row - v]);
    }
  }
}

void SurfaceMarker::mark(size_t tile_number, int dims_x, const TileRows& tile) const {
  PlacedTriangle placed;
  PreparedTriangle prepared;
  bins.for_each(tile_number, [&](size_t triangle) {
    if (!placed.place(mesh, triangle, map, dims_x, tile.range) || placed.low[0] > placed.high[0]) return;
    prepared.prepare(placed, separability == Separability::six);
    mark_triangle(placed, prepared, tile);
  });
}

}  // namespace ream::voxelizer
