#pragma once
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/spsc_ring.hpp"
#include "voxel/bone_model.hpp"

namespace ream::voxel {

/// What followers are told of a changed brick: its whole coverage at one tick, x fastest.
struct BrickImage {
  uint32_t brick = 0;
  uint32_t tick = 0;
  uint8_t coverage[brick_voxels];
};

/// Copies a brick's coverage out of, or into, a grid-ordered coverage array.
void read_brick(const VoxelGrid& grid, const uint8_t* coverage, uint32_t brick, uint8_t* image) noexcept;
void write_brick(const VoxelGrid& grid, uint8_t* coverage, uint32_t brick, const uint8_t* image) noexcept;

/// What a brick of that coverage adds to BoneModel::coverage_hash().
uint64_t brick_hash(uint32_t brick, const uint8_t* coverage) noexcept;

using BrickRing = SpscRing<BrickImage>;

/// The haptic thread's side of the brick ring: remembers which bricks changed and sends a bounded number of
/// images a tick. A brick whose image does not fit stays marked and goes later, so nothing is lost and the
/// loop never waits. Nothing is allocated after construction.
class BrickSender {
 public:
  BrickSender(const VoxelGrid& grid, BrickRing& ring);

  void mark(uint32_t brick) noexcept;
  /// Sends at most `budget` marked bricks, oldest mark first, as they are in `coverage` now.
  void send(const uint8_t* coverage, uint32_t tick, int budget) noexcept;
  size_t pending() const noexcept { return count_; }
  /// Bytes held, the ring apart.
  size_t bytes() const noexcept { return marked_.size() + queue_.size() * sizeof(uint32_t); }

 private:
  const VoxelGrid grid_;
  BrickRing& ring_;
  std::vector<uint8_t> marked_;
  std::vector<uint32_t> queue_;  ///< circular, holds each marked brick once
  size_t head_ = 0, count_ = 0;
};

}  // namespace ream::voxel
