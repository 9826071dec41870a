#pragma once
#include <memory>
#include <span>

#include "voxelizer/brick_store.hpp"
#include "voxelizer/raster_grid.hpp"
#include "voxelizer/tile_plan.hpp"

namespace ream::voxelizer {

/// Bits of a grid beyond which a set is kept as sparse bricks.
inline constexpr size_t usual_dense_bytes = size_t{1} << 30;

/// Which voxels of a grid are marked: one bit each, row after row, or, where that would take more than a
/// limit, the bricks (8^3) that hold any.
class VoxelSet {
 public:
  /// Empty, not yet marked. Memory for bits is taken here, but touched only when they are set.
  explicit VoxelSet(const RasterGrid& grid, size_t most_dense_bytes = usual_dense_bytes);

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
uint64_t count_marked(const TileRows& rows, Crew& crew);
/// Sets all of the rows' bits to 0.
void clear(const TileRows& rows);

}  // namespace ream::voxelizer
