#include "voxelizer/mark_triangle.hpp"

#include <algorithm>
#include <cstring>

#include "core/vector_clones.hpp"
#include "voxelizer/marked_rows.hpp"

namespace ream::voxelizer {
namespace {

constexpr int lanes = 8;

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

inline void set_two_words(uint32_t* words, long long bits) {
  long long there;
  std::memcpy(&there, words, sizeof there);
  there |= bits;
  std::memcpy(words, &there, sizeof there);
}

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

/// Of a triangle whose box has four rows a layer or fewer and lies within two words of each: most triangles
/// of a fine mesh. Without a branch on what is marked.
struct NarrowBox {
  int first_word;

  /// Whether it is one.
  bool holds(const PlacedTriangle& t, const TileRows& tile) {
    const int words = static_cast<int>(tile.words_per_row);
    first_word = std::min(t.low[0] >> 5, words - 2);
    return first_word >= 0 && t.high[1] - t.low[1] < 4 && t.high[0] - 32 * first_word < 63;
  }

  void mark(const PlacedTriangle& t, const PreparedTriangle& p, const TileRows& tile) const {
    // What is written of rows behind the last is nothing, to a place beside.
    uint32_t beside[2] = {};
    uint32_t* words[4];
    size_t layer_words[4];
    for (int i = 0; i < 4; ++i) {
      const bool is_row = i <= t.high[1] - t.low[1];
      words[i] = is_row ? tile.row(t.low[1] + i, t.low[2]) + first_word : beside;
      layer_words[i] = is_row ? tile.words_per_row * tile.rows_per_layer : 0;
    }

    const Double4 at_v = static_cast<double>(t.low[1]) + Double4{0.0, 1.0, 2.0, 3.0};
    const Double4 row_least = p.u_by_v.most(at_v), row_most = p.u_by_v.least(at_v);
    const Double4 row_plane = p.plane.at + p.plane.by_v * at_v;
    const Double4 low = Double4{} + static_cast<double>(t.low[0]);
    const Double4 high = Double4{} + static_cast<double>(t.high[0]);
    const Double4 last_v = Double4{} + static_cast<double>(t.high[1]);
    const Long4 one = Long4{} + 1;
    const int base = 32 * first_word;
    LayerBounds layers;
    for (int w = t.low[2]; w <= t.high[2]; w += 4) {
      layers.set(p, w);
      const Double4 v_most = smaller(layers.v_most, last_v);
      const int count = std::min(4, t.high[2] - w + 1);
      for (int j = 0; j < count; ++j) {
        const Double4 middle = row_plane + layers.plane[j];
        const Double4 least =
            larger(larger(row_least, Double4{} + layers.u_least[j]), middle - p.plane.width);
        const Double4 most = smaller(smaller(row_most, Double4{} + layers.u_most[j]), middle + p.plane.width);
        const Long4 from = whole_from(smaller(larger(least, low), high + 1.0)) - base;
        const Long4 end = whole_up_to(smaller(larger(most, low - 1.0), high)) - (base - 1);
        const Long4 marked = (from < end) & (at_v >= layers.v_least[j]) & (at_v <= v_most[j]);
        const Long4 bits = ((one << end) - (one << from)) & marked;
        for (int i = 0; i < 4; ++i) {
          set_two_words(words[i], bits[i]);
          words[i] += layer_words[i];
        }
      }
    }
  }
};

/// Eight triangles, one a lane.
struct Batch {
  Placed<Double8> placed;
  Prepared<Double8> prepared;

  void set(const SurfaceMarker& marker, const uint32_t* triangles, int dims_x, const RowRange& rows) {
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
    prepared.prepare(placed, marker.separability == Separability::six);
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
  marker.bins.for_each_few<lanes>(tile_number, [&](const uint32_t* triangles, int count) {
    batch.set(marker, triangles, dims_x, tile.range);
    for (int lane = 0; lane < count; ++lane) {
      const PlacedTriangle t = batch.box(lane);
      if (t.low[0] > t.high[0] || t.low[1] > t.high[1] || t.low[2] > t.high[2]) continue;
      NarrowBox narrow;
      if (narrow.holds(t, tile))
        narrow.mark(t, batch.triangle(lane), tile);
      else
        for_each_four_rows(t, batch.triangle(lane), [&](const FourRows& four) { set_rows(four, tile); });
    }
  });
}

}  // namespace

void SurfaceMarker::mark(size_t tile_number, int dims_x, const TileRows& tile) const {
  mark_all(*this, tile_number, dims_x, tile);
}

}  // namespace ream::voxelizer
