#include "voxelizer/mark_triangle.hpp"

#include <cstring>

#include "core/vector_clones.hpp"
#include "voxelizer/marked_rows.hpp"
#include "voxelizer/narrow_boxes.hpp"

namespace ream::voxelizer {
namespace {

constexpr int lanes = 8;

/// Runs of up to 32 voxels lie within two words each and are set without a branch, longer ones word by word.
inline void set_rows(const FourRows& four, const TileRows& tile) {
  const Long4 one = Long4{} + 1;
  const long long last_pair = static_cast<long long>(tile.words_per_row) - 2;
  const Long4 word = smaller(four.first >> 5, Long4{} + last_pair);
  const Long4 first = four.first - (word << 5), end = four.end - (word << 5);
  const Long4 is_long = four.marked & (end > 63);
  if (last_pair < 0 || (is_long[0] | is_long[1] | is_long[2] | is_long[3]) != 0) {
    for (int i = 0; i < 4; ++i)
      if (four.marked[i] != 0)
        set_bits(tile.row(four.v + i, four.w), static_cast<int>(four.first[i]),
                 static_cast<int>(four.end[i]) - 1);
    return;
  }
  const Long4 bits = ((one << (end & 63)) - (one << (first & 63))) & four.marked;
  uint32_t beside[2] = {};
  uint32_t* row = tile.row(four.v, four.w);
  for (int i = 0; i < 4; ++i, row += tile.words_per_row)
    set_two_words(bits[i] != 0 ? row + word[i] : beside, bits[i]);
}

/// Eight triangles, one a lane.
struct Batch {
  Placed<Double8> placed;
  Prepared<Double8> prepared;

  void place(const SurfaceMarker& marker, const uint32_t* triangles, int dims_x, const RowRange& rows) {
    float corners[3][3][lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      const auto& indices = marker.mesh.triangles[triangles[lane]];
      for (size_t i = 0; i < 3; ++i) {
        const float* corner = marker.mesh.vertices_mm[indices[i]].data();
        for (int k = 0; k < 3; ++k) corners[k][i][lane] = corner[k];
      }
    }
    Double8 file[3][3];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) {
        Float8 lane_floats;
        std::memcpy(&lane_floats, corners[k][i], sizeof lane_floats);
        file[k][i] = __builtin_convertvector(lane_floats, Double8);
      }
    placed.place(file, marker.map, dims_x, rows);
  }

  /// Only the box.
  PlacedTriangle box(int lane) const {
    PlacedTriangle t;
    for (int k = 0; k < 3; ++k) {
      t.low[k] = placed.low[k][lane];
      t.high[k] = placed.high[k][lane];
    }
    return t;
  }

  static EdgeBounds<double> edges(const EdgeBounds<Double8>& of, int lane) {
    EdgeBounds<double> b;
    for (int i = 0; i < 3; ++i) {
      b.lower[i] = of.lower[i][lane];
      b.upper[i] = of.upper[i][lane];
      b.slope[i] = of.slope[i][lane];
    }
    return b;
  }
  PreparedTriangle triangle(int lane) const {
    const PlaneBound<Double8>& plane = prepared.plane;
    return {edges(prepared.u_by_v, lane),
            edges(prepared.u_by_w, lane),
            edges(prepared.v_by_w, lane),
            {plane.at[lane], plane.by_v[lane], plane.by_w[lane], plane.width[lane]}};
  }
};

REAM_VECTOR_CLONES __attribute__((flatten)) void mark_all(const SurfaceMarker& marker, size_t tile_number,
                                                          int dims_x, const TileRows& tile) {
  Batch batch;
  NarrowBoxes narrow;
  marker.bins.for_each_few<lanes>(tile_number, [&](const uint32_t* triangles, int count) {
    batch.place(marker, triangles, dims_x, tile.range);
    if (!narrow.set(batch.placed, static_cast<int>(tile.words_per_row), count)) return;
    batch.prepared.prepare(batch.placed, marker.separability == Separability::six);
    narrow.mark(batch.placed, batch.prepared, tile);
    for (int lane = 0; lane < count; ++lane) {
      if (narrow.holds(lane)) continue;
      const PlacedTriangle t = batch.box(lane);
      if (t.low[0] > t.high[0] || t.low[1] > t.high[1] || t.low[2] > t.high[2]) continue;
      for_each_four_rows(t, batch.triangle(lane), [&](const FourRows& four) { set_rows(four, tile); });
    }
  });
}

}  // namespace

void SurfaceMarker::mark(size_t tile_number, int dims_x, const TileRows& tile) const {
  mark_all(*this, tile_number, dims_x, tile);
}

}  // namespace ream::voxelizer
