#pragma once
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "record/ops.hpp"
#include "voxel/bricks.hpp"

namespace ream::record {

/// Coverage of one brick, x fastest.
struct BrickCoverage {
  uint8_t level[voxel::brick_voxels];
};

/// Bricks that differ from the start, by index.
using BrickCoverages = std::unordered_map<uint32_t, BrickCoverage>;

/// The `images` of a bricks op: as many u32 as it has bricks, each index less the one before (ascending),
/// then 512 bytes a brick, by how much the coverage of each voxel has fallen (modulo 256, x fastest) since
/// the bricks op before, or in a key since the start. A voxel is cut once and most of a brick stays, so most
/// of it is zero.
class BrickDeltaWriter {
 public:
  /// Bricks ascending. `before` is what the reader holds of it, `now` what it shall hold.
  void add(uint32_t brick, const uint8_t* before, const uint8_t* now);
  uint32_t count() const { return static_cast<uint32_t>(indices_.size()); }
  ops::Bytes take();

 private:
  std::vector<uint32_t> indices_;
  ops::Bytes falls_;
};

/// Calls `told` with each brick's index and its 512 falls. Error invalid_input when the bytes do not fit the
/// count or a brick is not among `brick_count`.
void read_brick_deltas(const ops::Bricks& op, size_t brick_count,
                       const std::function<void(uint32_t brick, const uint8_t* falls)>& visit);

}  // namespace ream::record
