#include "voxelizer/flip_triangle.hpp"

#include "voxelizer/bounds.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {
namespace {

/// Index of the first voxel whose centre is not before x.
inline int first_centre_from(double x, int low, int high) { return ceil_between(x - 0.5, low, high); }

}  // namespace

FlipEdges flip_edges(const PlacedTriangle& t) {
  FlipEdges edges;
  for (int i = 0; i < 3; ++i) {
    const double* a = t.corner[i];
    const double* b = t.corner[(i + 1) % 3];
    const double* low = a[2] < b[2] ? a : b;
    const double* high = a[2] < b[2] ? b : a;
    const double rise = high[2] - low[2];
    edges.lower[i] = low[2];
    edges.upper[i] = high[2];
    edges.y_by_z[i] = (high[1] - low[1]) / (rise > 0.0 ? rise : 1.0);
    edges.y[i] = low[1] - edges.y_by_z[i] * low[2];
  }
  return edges;
}

void flip_triangle(const PlacedTriangle& t, const PreparedTriangle& p, int dims_x, const TileRows& tile) {
  const FlipEdges edges = flip_edges(t);
  // The plane's x is held within the triangle, which matters where it is steep.
  const double least = smaller(smaller(t.corner[0][0], t.corner[1][0]), t.corner[2][0]) - 0.5;
  const double most = larger(larger(t.corner[0][0], t.corner[1][0]), t.corner[2][0]) - 0.5;
  for (int w = t.low[2]; w <= t.high[2]; ++w) {
    const double z = static_cast<double>(w) + 0.5;
    double first = 1e30, last = -1e30;
    for (int i = 0; i < 3; ++i) {
      if (!(edges.lower[i] <= z && z < edges.upper[i])) continue;
      const double y = edges.y[i] + edges.y_by_z[i] * z;
      first = smaller(first, y);
      last = larger(last, y);
    }
    if (first > last) continue;
    const int begin = first_centre_from(first, tile.range.v_begin, tile.range.v_end);
    const int end = first_centre_from(last, tile.range.v_begin, tile.range.v_end);
    const double plane = p.plane + p.plane_by_w * static_cast<double>(w);
    for (int v = begin; v < end; ++v) {
      const double x = plane + p.plane_by_v * static_cast<double>(v);
      const int u = ceil_between(smaller(larger(x, least), most), 0, dims_x);
      if (u < dims_x) tile.row(v, w)[u >> 5] ^= 1u << (u & 31);
    }
  }
}

void fill_between_flips(uint32_t* row, int dims_x) {
  uint32_t before = 0;  // all ones behind an odd number of flips
  const int words = (dims_x + 31) / 32;
  for (int i = 0; i < words; ++i) {
    uint32_t bits = row[i];
    if (bits != 0) {
      bits ^= bits << 1;
      bits ^= bits << 2;
      bits ^= bits << 4;
      bits ^= bits << 8;
      bits ^= bits << 16;
    }
    bits ^= before;
    before = 0u - (bits >> 31);
    row[i] = bits;
  }
  if ((dims_x & 31) != 0) row[words - 1] &= ~0u >> (32 - (dims_x & 31));
}

void SolidFiller::fill(size_t tile_number, int dims_x, const TileRows& tile) const {
  PlacedTriangle placed;
  PreparedTriangle prepared;
  bins.for_each(tile_number, [&](size_t triangle) {
    if (!placed.place(mesh, triangle, map, dims_x, tile.range)) return;
    prepared.prepare_plane(placed);
    flip_triangle(placed, prepared, dims_x, tile);
  });
  for (int w = tile.range.w_begin; w < tile.range.w_end; ++w)
    for (int v = tile.range.v_begin; v < tile.range.v_end; ++v) fill_between_flips(tile.row(v, w), dims_x);
}

}  // namespace ream::voxelizer
