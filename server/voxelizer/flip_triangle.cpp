#include "voxelizer/triangle_marking.hpp"

#include <cstring>

#include "core/vector_clones.hpp"
#include "voxelizer/prepared_triangle.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {
namespace {

/// Where a triangle's edges pass the lines of voxel centres along x: what the parity of a solid is made of.
/// An edge is written from its lower to its upper end in z, so that both triangles that share it get the same
/// numbers and no line slips between them or counts twice.
struct FlipEdges {
  double lower[3], upper[3];  ///< z from which and below which a line passes the edge; none: lower == upper
  double y[3], y_by_z[3];     ///< y + y_by_z * z on it
};

/// Index of the first voxel whose centre is not before x.
inline int first_centre_from(double x, int low, int high) { return ceil_between(x - 0.5, low, high); }

FlipEdges flip_edges(const PlacedTriangle& t) {
  FlipEdges edges;
  for (int i = 0; i < 3; ++i) {
    const int next = i == 2 ? 0 : i + 1;
    const bool rises = t.at[2][i] < t.at[2][next];
    const int low = rises ? i : next, high = rises ? next : i;
    const double rise = t.at[2][high] - t.at[2][low];
    edges.lower[i] = t.at[2][low];
    edges.upper[i] = t.at[2][high];
    edges.y_by_z[i] = (t.at[1][high] - t.at[1][low]) / (rise > 0.0 ? rise : 1.0);
    edges.y[i] = t.at[1][low] - edges.y_by_z[i] * t.at[2][low];
  }
  return edges;
}

/// Flips, in every row whose line of centres passes the triangle, the first voxel whose centre lies behind
/// it.
inline void flip_triangle(const PlacedTriangle& t, const PlaneBound<double>& p, int dims_x,
                          const TileRows& tile) {
  const FlipEdges edges = flip_edges(t);
  // The plane's x is held within the triangle, which matters where it is steep.
  const double least = smallest(t.at[0]) - 0.5, most = largest(t.at[0]) - 0.5;
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
    const int begin = first_centre_from(first, t.low[1], t.high[1] + 1);
    const int end = first_centre_from(last, t.low[1], t.high[1] + 1);
    const double plane = p.at + p.by_w * static_cast<double>(w);
    for (int v = begin; v < end; ++v) {
      const double x = plane + p.by_v * static_cast<double>(v);
      const int u = ceil_between(smaller(larger(x, least), most), 0, dims_x);
      if (u < dims_x) tile.row(v, w)[u >> 5] ^= 1u << (u & 31);
    }
  }
}

}  // namespace

void fill_between_flips(uint32_t* row, int dims_x) {
  uint64_t before = 0;  // all ones behind an odd number of flips
  const int words = (dims_x + 31) / 32;
  for (int i = 0; i < words; i += 2) {
    const size_t bytes = i + 1 < words ? 8 : 4;
    uint64_t bits = 0;
    std::memcpy(&bits, row + i, bytes);
    if (bits != 0)
      for (int shift = 1; shift < 64; shift *= 2) bits ^= bits << shift;
    bits ^= before;
    before = 0u - (bits >> (8 * bytes - 1) & 1u);
    std::memcpy(row + i, &bits, bytes);
  }
  if ((dims_x & 31) != 0) row[words - 1] &= ~0u >> (32 - (dims_x & 31));
}

REAM_VECTOR_CLONES __attribute__((flatten)) void SolidFiller::fill(size_t tile_number, int dims_x,
                                                                   const TileRows& tile) const {
  bins.for_each(tile_number, [&](size_t triangle) {
    PlacedTriangle placed;
    if (!placed.place(mesh, triangle, map, dims_x, tile.range)) return;
    double normal[3];
    placed.exact_normal(normal);
    PlaneBound<double> plane;
    plane.set(placed, normal, false);
    flip_triangle(placed, plane, dims_x, tile);
  });
  for (int w = tile.range.w_begin; w < tile.range.w_end; ++w)
    for (int v = tile.range.v_begin; v < tile.range.v_end; ++v) fill_between_flips(tile.row(v, w), dims_x);
}

}  // namespace ream::voxelizer
