#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "voxelizer/raster_grid.hpp"
#include "voxelizer/tile_plan.hpp"

namespace ream::voxelizer {

/// The marked voxels of one tile as bricks of 8 x 8 x 8: 64 bytes for one that is partly marked, a run along
/// u for full ones, nothing for empty ones.
class BrickStore {
 public:
  void take(const TileRows& rows);
  size_t bytes() const;
  /// Bits of a row, counted from the tile's first; `words` covers all u. False when none is set.
  bool read_row(int v, int w, std::span<uint32_t> words) const;

 private:
  /// Bricks from number `first` along u: `full` of them full, or, where that is 0, one whose bits are kept.
  struct Run {
    uint32_t first, full;
  };
  /// The bricks of eight rows in eight layers.
  struct Line {
    uint32_t first_run, runs;
    size_t first_bits;  ///< of the partly marked ones, in bricks
  };
  void take_line(const TileRows& rows, int v, int w);

  int lines_v_ = 0;
  std::vector<Line> lines_;  ///< none where the tile is empty
  std::vector<Run> runs_;
  std::vector<uint8_t> bits_;  ///< 64 a brick: [w][v], lowest bit the lowest u
};

/// Bits of a grid beyond which a set is kept as sparse bricks.
inline constexpr size_t default_dense_bytes = size_t{1} << 30;

/// Which voxels of a grid are marked: one bit each, row after row, or, where that would take more than a
/// limit, the bricks (8^3) that hold any.
class VoxelSet {
 public:
  /// Empty, not yet marked. Memory for bits is taken here, but touched only when they are set.
  explicit VoxelSet(const RasterGrid& grid, size_t max_dense_bytes = default_dense_bytes);

  const RasterGrid& grid() const { return grid_; }
  bool sparse() const { return words_ == nullptr; }
  /// Marked voxels; known once a voxelizer has filled the set.
  uint64_t filled() const { return filled_; }
  /// Bytes that the marked voxels take.
  size_t bytes() const;

  /// The bits of row (v, w) are put into `words`, which has grid().words_per_row(). False when none is set.
  bool read_row(int v, int w, std::span<uint32_t> words) const;
  bool marked(int u, int v, int w) const;

  /// Bits of the whole grid when not sparse: row v + dims.y * w begins at words_per_row() times that.
  uint32_t* words() { return words_.get(); }
  const uint32_t* words() const { return words_.get(); }
  size_t word_count() const { return grid_.rows() * grid_.words_per_row(); }

  /// For voxelizers. A sparse set is made of the tiles of a plan.
  void begin_bricks(const TilePlan& plan);
  /// Rows to be filled: of the whole grid, or, where bricks are kept, of `memory`.
  TileRows rows_of(const RowRange& range, std::vector<uint32_t>& memory);
  void set_bricks(size_t tile, const TileRows& rows) { bricks_[tile].take(rows); }
  void set_filled(uint64_t voxels) { filled_ = voxels; }

 private:
  RasterGrid grid_;
  std::unique_ptr<uint32_t[]> words_;
  TilePlan plan_;
  std::vector<BrickStore> bricks_;
  uint64_t filled_ = 0;
};

/// Marked voxels in some rows.
uint64_t count_marked(const TileRows& rows);
uint64_t count_marked(const TileRows& rows, ThreadPool& pool);
/// Sets all of the rows' bits to 0.
void clear(const TileRows& rows);

}  // namespace ream::voxelizer
