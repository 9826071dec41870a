#include "voxelizer/triangle_marking.hpp"

#include <cstdint>
#include <cstring>

#include "core/vector_clones.hpp"
#include "voxelizer/marked_rows.hpp"
#include "voxelizer/prepared_triangle.hpp"
#include "voxelizer/tile_plan.hpp"

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

/// Sets those of 64 bits that begin with a word.
inline void set_two_words(uint32_t* words, long long bits) {
  long long there;
  std::memcpy(&there, words, sizeof there);
  there |= bits;
  std::memcpy(words, &there, sizeof there);
}

/// Those of eight triangles whose boxes have up to eight rows and eight layers and lie within two words of
/// each row: most triangles of a fine mesh. They are marked together, a triangle a lane, without a branch on
/// what is marked.
class NarrowBoxes {
 public:
  static constexpr int max_rows = 8;

  /// Of the first `count` triangles. False when the box of none of them, narrow or not, touches the tile.
  bool set(const Placed<Double8>& t, int words_per_row, int count) {
    rows_ = layers_ = 0;
    int touching = 0;
    const Int8 word = t.low[0] >> 5, last_pair = Int8{} + (words_per_row - 2);
    first_word_ = word < last_pair ? word : last_pair;
    const Int8 rows = t.high[1] - t.low[1] + 1, layers = t.high[2] - t.low[2] + 1;
    const Int8 touches = (rows > 0) & (layers > 0) & (t.low[0] <= t.high[0]);
    const Int8 narrow = touches & (first_word_ >= 0) & (rows <= max_rows) & (layers <= max_rows) &
                        (t.high[0] - (first_word_ << 5) < 63);
    for (int lane = 0; lane < 8; ++lane) {
      touching |= touches[lane];
      const bool holds = lane < count && narrow[lane] != 0;
      lane_rows_[lane] = holds ? rows[lane] : 0;
      lane_layers_[lane] = holds ? layers[lane] : 0;
      rows_ = lane_rows_[lane] > rows_ ? lane_rows_[lane] : rows_;
      layers_ = lane_layers_[lane] > layers_ ? lane_layers_[lane] : layers_;
    }
    return touching != 0;
  }
  bool holds(int lane) const { return lane_rows_[lane] != 0; }

  void mark(const Placed<Double8>& t, const Prepared<Double8>& p, const TileRows& tile) const {
    Long8 bits[max_rows][max_rows];
    find(t, p, bits);
    const size_t row_words = tile.words_per_row, layer_words = row_words * tile.rows_per_layer;
    for (int lane = 0; lane < 8; ++lane) {
      if (!holds(lane)) continue;
      uint32_t* layer = tile.row(t.low[1][lane], t.low[2][lane]) + first_word_[lane];
      for (int j = 0; j < lane_layers_[lane]; ++j, layer += layer_words) {
        uint32_t* row = layer;
        for (int i = 0; i < lane_rows_[lane]; ++i, row += row_words) set_two_words(row, bits[j][i][lane]);
      }
    }
  }

 private:
  /// Which bits of a box's two words are marked, [layer][row].
  void find(const Placed<Double8>& t, const Prepared<Double8>& p, Long8 (&bits)[max_rows][max_rows]) const {
    Double8 at_v[max_rows], row_least[max_rows], row_most[max_rows], row_plane[max_rows];
    const Double8 first_v = __builtin_convertvector(t.low[1], Double8);
    for (int i = 0; i < rows_; ++i) {
      at_v[i] = first_v + static_cast<double>(i);
      row_least[i] = p.u_by_v.most(at_v[i]);
      row_most[i] = p.u_by_v.least(at_v[i]);
      row_plane[i] = p.plane.at + p.plane.by_v * at_v[i];
    }
    const Double8 first_w = __builtin_convertvector(t.low[2], Double8);
    const Double8 low = __builtin_convertvector(t.low[0], Double8);
    const Double8 high = __builtin_convertvector(t.high[0], Double8);
    const Double8 last_v = __builtin_convertvector(t.high[1], Double8);
    const Double8 base = __builtin_convertvector(first_word_ << 5, Double8);
    for (int j = 0; j < layers_; ++j) {
      const Double8 at_w = first_w + static_cast<double>(j);
      const Double8 u_least = p.u_by_w.most(at_w), u_most = p.u_by_w.least(at_w);
      const Double8 v_least = p.v_by_w.most(at_w), v_most = smaller(p.v_by_w.least(at_w), last_v);
      const Double8 layer_plane = p.plane.by_w * at_w;
      for (int i = 0; i < rows_; ++i) {
        const Double8 middle = row_plane[i] + layer_plane;
        const Double8 least = larger(larger(row_least[i], u_least), middle - p.plane.width);
        const Double8 most = smaller(smaller(row_most[i], u_most), middle + p.plane.width);
        // Two choices, since compilers make no masks of one by two comparisons.
        const Double8 last = at_v[i] <= v_most ? most : low - 1.0;
        const Double8 first = at_v[i] >= v_least ? least : high + 1.0;
        const Double8 end = shifted_down(smaller(larger(last, low - 1.0), high)) + (1.0 - base);
        const Double8 from = smaller(shifted_up(smaller(larger(first, low), high + 1.0)) - base, end);
        bits[j][i] = reinterpret_cast<Long8>(bit_at(end) - bit_at(from));
      }
    }
  }

  int rows_ = 0, layers_ = 0;  ///< of the largest
  Int8 first_word_{};
  int lane_rows_[8] = {}, lane_layers_[8] = {};  ///< 0: not narrow
};

constexpr int lanes = 8;

/// Runs of up to 32 voxels lie within two words each and are set without a branch, longer ones word by word.
inline void set_rows(const FourRows& four, const TileRows& tile) {
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
  // Unsigned: a run may end at bit 63.
  const ULong4 one = ULong4{} + 1;
  const ULong4 run =
      (one << reinterpret_cast<ULong4>(end & 63)) - (one << reinterpret_cast<ULong4>(first & 63));
  const Long4 bits = reinterpret_cast<Long4>(run) & four.marked;
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

// Three stages with the choice of instructions before each, since compilers take several times as long for
// one function of all three.

/// False when the boxes of none of the triangles touch the tile.
REAM_VECTOR_CLONES __attribute__((flatten)) bool place(Batch& batch, NarrowBoxes& narrow,
                                                       const SurfaceMarker& marker, const uint32_t* triangles,
                                                       int count, int dims_x, const TileRows& tile) {
  batch.place(marker, triangles, dims_x, tile.range);
  return narrow.set(batch.placed, static_cast<int>(tile.words_per_row), count);
}

REAM_VECTOR_CLONES __attribute__((flatten)) void prepare(Batch& batch, bool thin) {
  batch.prepared.prepare(batch.placed, thin);
}

REAM_VECTOR_CLONES __attribute__((flatten)) void mark_narrow(const Batch& batch, const NarrowBoxes& narrow,
                                                             const TileRows& tile) {
  narrow.mark(batch.placed, batch.prepared, tile);
}

REAM_VECTOR_CLONES __attribute__((flatten)) void mark_wide(const PlacedTriangle& box,
                                                           const PreparedTriangle& triangle,
                                                           const TileRows& tile) {
  for_each_four_rows(box, triangle, [&](const FourRows& four) { set_rows(four, tile); });
}

}  // namespace

void SurfaceMarker::mark(size_t tile_number, int dims_x, const TileRows& tile) const {
  Batch batch;
  NarrowBoxes narrow;
  bins.for_each_few<lanes>(tile_number, [&](const uint32_t* triangles, int count) {
    if (!place(batch, narrow, *this, triangles, count, dims_x, tile)) return;
    prepare(batch, separability == Separability::six);
    mark_narrow(batch, narrow, tile);
    for (int lane = 0; lane < count; ++lane) {
      if (narrow.holds(lane)) continue;
      const PlacedTriangle box = batch.box(lane);
      if (box.low[0] > box.high[0] || box.low[1] > box.high[1] || box.low[2] > box.high[2]) continue;
      mark_wide(box, batch.triangle(lane), tile);
    }
  });
}

}  // namespace ream::voxelizer
