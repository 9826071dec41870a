#include "voxelizer/mark_triangle.hpp"

#include "core/vector_clones.hpp"
#include "voxelizer/marked_rows.hpp"

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

REAM_VECTOR_CLONES __attribute__((flatten)) void mark_all(const SurfaceMarker& marker, size_t tile_number,
                                                          int dims_x, const TileRows& tile) {
  const bool thin = marker.separability == Separability::six;
  marker.bins.for_each(tile_number, [&](size_t triangle) {
    PlacedTriangle placed;
    if (!placed.place(marker.mesh, triangle, marker.map, dims_x, tile.range)) return;
    if (placed.low[0] > placed.high[0]) return;
    PreparedTriangle prepared;
    prepared.prepare(placed, thin);
    for_each_marked_row(placed, prepared,
                        [&](int v, int w, int from, int to) { set_bits(tile.row(v, w), from, to); });
  });
}

}  // namespace

void SurfaceMarker::mark(size_t tile_number, int dims_x, const TileRows& tile) const {
  mark_all(*this, tile_number, dims_x, tile);
}

}  // namespace ream::voxelizer
