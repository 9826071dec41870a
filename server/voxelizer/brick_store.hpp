#pragma once
#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace ream::voxelizer
