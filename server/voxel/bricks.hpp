#pragma once
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/spsc_ring.hpp"
#include "voxel/bone_model.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::voxel {

/// Files and CT filters keep voxels row after row (VoxelGrid::row_index), a BoneModel brick after brick
/// (VoxelGrid::index); these turn one into the other. Both sizes must be grid.voxel_count().
std::vector<uint8_t> bricks_from_rows(const VoxelGrid& grid, std::span<const uint8_t> rows);
std::vector<uint8_t> rows_from_bricks(const VoxelGrid& grid, std::span<const uint8_t> bricks);

/// What followers get of a changed brick: its whole coverage at one tick, x fastest.
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

/// A follower's own copy of the coverage, brought up to date by brick images. Owned by one thread.
class Replica {
 public:
  /// Copies the coverage as it is before the first tick.
  explicit Replica(const BoneModel& bone) : grid_(bone.grid), coverage_(bone.coverage) {}

  void apply(const BrickImage& image) noexcept {
    write_brick(grid_, coverage_.data(), image.brick, image.coverage);
  }

  /// The brick's coverage, brick_voxels bytes, x fastest.
  const uint8_t* brick(uint32_t index) const { return coverage_.data() + size_t{index} * brick_voxels; }
  const VoxelGrid& grid() const { return grid_; }
  const std::vector<uint8_t>& coverage() const { return coverage_; }

 private:
  VoxelGrid grid_;
  std::vector<uint8_t> coverage_;
};

}  // namespace ream::voxel
