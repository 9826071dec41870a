#pragma once
#include "voxelizer/prepared_triangle.hpp"
#include "voxelizer/tile_plan.hpp"
#include "voxelizer/word_bits.hpp"

// Twin of kernels/voxelizer.cl: the same double operations in the same order, so the same bits.
namespace ream::voxelizer {

/// Those of eight triangles whose boxes have up to eight rows and eight layers and lie within two words of
/// each row: most triangles of a fine mesh. They are marked together, a triangle a lane, without a branch on
/// what is marked.
class NarrowBoxes {
 public:
  static constexpr int most_rows = 8;

  /// Of the first `count` triangles. False when the box of none of them, narrow or not, touches the tile.
  bool set(const Placed<Double8>& t, int words_per_row, int count) {
    rows_ = layers_ = 0;
    int touching = 0;
    const Int8 word = t.low[0] >> 5, last_pair = Int8{} + (words_per_row - 2);
    first_word_ = word < last_pair ? word : last_pair;
    const Int8 rows = t.high[1] - t.low[1] + 1, layers = t.high[2] - t.low[2] + 1;
    const Int8 touches = (rows > 0) & (layers > 0) & (t.low[0] <= t.high[0]);
    const Int8 narrow = touches & (first_word_ >= 0) & (rows <= most_rows) & (layers <= most_rows) &
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
    Long8 bits[most_rows][most_rows];
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
  void find(const Placed<Double8>& t, const Prepared<Double8>& p, Long8 (&bits)[most_rows][most_rows]) const {
    Double8 at_v[most_rows], row_least[most_rows], row_most[most_rows], row_plane[most_rows];
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
        bits[j][i] = bit_at(end) - bit_at(from);
      }
    }
  }

  int rows_ = 0, layers_ = 0;  ///< of the largest
  Int8 first_word_{};
  int lane_rows_[8] = {}, lane_layers_[8] = {};  ///< 0: not narrow
};

}  // namespace ream::voxelizer
