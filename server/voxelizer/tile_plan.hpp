#pragma once
#include <cstdint>
#include <vector>

#include "core/crew.hpp"
#include "voxelizer/raster_grid.hpp"
#include "voxelizer/triangle_lists.hpp"

namespace ream::voxelizer {

/// Rows of bits of one tile: all u, some (v,w). They may stand in the whole grid or in memory of their own.
struct TileRows {
  RowRange range;
  uint32_t* words = nullptr;  ///< of row (v_begin, w_begin)
  size_t words_per_row = 0;
  size_t rows_per_layer = 0;  ///< between equal v of neighbouring w

  uint32_t* row(int v, int w) const {
    return words + words_per_row * (static_cast<size_t>(v - range.v_begin) +
                                    rows_per_layer * static_cast<size_t>(w - range.w_begin));
  }
};

/// A grid cut into tiles of whole rows, so that each can be worked on by itself, without atomics and in a
/// processor's cache. Tile (i, j) is number i + count_v * j.
struct TilePlan {
  int rows = 0, layers = 0;  ///< of a tile; the last ones have fewer
  int count_v = 0, count_w = 0;
  Vec3i dims = Vec3i::Zero();

  size_t count() const { return static_cast<size_t>(count_v) * static_cast<size_t>(count_w); }
  RowRange range(size_t tile) const;
  /// The tile that row (v, w) is in.
  size_t tile_of(int v, int w) const {
    return static_cast<size_t>(v / rows) + static_cast<size_t>(count_v) * static_cast<size_t>(w / layers);
  }
};

/// Tiles of up to about `tile_bytes` bytes of bits, their sides multiples of 8, and about `least_tiles` or
/// more where the grid has the layers for it. `whole_layers` keeps layers whole, however large they are.
TilePlan plan_tiles(const RasterGrid& grid, size_t tile_bytes, size_t least_tiles, bool whole_layers = false);

/// Boxes of triangles by their rows and layers: about two, three, four, five, more of each.
struct BoxSize {
  static constexpr int sides = 5, count = sides * sides;
};

/// Which triangles may touch which tile. One thread's lists keep the order of the mesh.
class TileBins {
 public:
  /// Where lists would take more than `most_bytes` there are none and every tile looks at all triangles.
  TileBins(const TriangleMesh& mesh, const VoxelMap& map, const TilePlan& plan, Crew& crew,
           size_t most_bytes = size_t{48} << 20);

  /// Calls visit(triangle) for every triangle that may touch the tile.
  template <class Visit>
  void for_each(size_t tile, Visit visit) const {
    for_each_sized(tile, [&](size_t triangle, int) { visit(triangle); });
  }
  /// As for_each, some at a time and, as far as it goes, of one size: visit(triangles, count) for up to `few`
  /// of them; those behind the last repeat it.
  template <int few, class Visit>
  void for_each_few(size_t tile, Visit visit) const {
    uint32_t some[BoxSize::count][few];
    int counts[BoxSize::count] = {};
    for_each_sized(tile, [&](size_t triangle, int size) {
      int& count = counts[size];
      some[size][count++] = static_cast<uint32_t>(triangle);
      if (count < few) return;
      count = 0;
      visit(some[size], few);
    });
    uint32_t rest[few];
    int count = 0;
    for (int size = 0; size < BoxSize::count; ++size)
      for (int i = 0; i < counts[size]; ++i) {
        rest[count++] = some[size][i];
        if (count < few) continue;
        count = 0;
        visit(rest, few);
      }
    if (count == 0) return;
    for (int i = count; i < few; ++i) rest[i] = rest[count - 1];
    visit(rest, count);
  }
  bool listed() const { return listed_; }
  /// All tiles, those with most triangles first, so that threads that share them end at about the same time.
  std::vector<size_t> largest_first(size_t tiles) const;

 private:
  template <class Visit>
  void for_each_sized(size_t tile, Visit visit) const {
    if (!listed_)
      for (size_t triangle = 0; triangle < triangles_; ++triangle) visit(triangle, 0);
    else
      for (const TriangleLists& lists : lists_) lists.for_each(tile, visit);
  }

  size_t triangles_ = 0;
  bool listed_ = false;
  std::vector<TriangleLists> lists_;  ///< a worker's each
};

}  // namespace ream::voxelizer
