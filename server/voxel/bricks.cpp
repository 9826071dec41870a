#include "voxel/bricks.hpp"

#include "core/hash.hpp"

namespace ream::voxel {

void read_brick(const VoxelGrid& grid, const uint8_t* coverage, uint32_t brick, uint8_t* image) noexcept {
  std::memcpy(image, coverage + grid.brick_base(brick), brick_voxels);
}

void write_brick(const VoxelGrid& grid, uint8_t* coverage, uint32_t brick, const uint8_t* image) noexcept {
  std::memcpy(coverage + grid.brick_base(brick), image, brick_voxels);
}

uint64_t brick_hash(uint32_t brick, const uint8_t* coverage) noexcept {
  const uint64_t base = uint64_t{brick} * brick_voxels;
  uint64_t sum = 0;
  for (uint64_t k = 0; k < brick_voxels; ++k)
    if (coverage[k] != 0) sum += mix64((base + k) * 256 + coverage[k]);
  return sum;
}

BrickSender::BrickSender(const VoxelGrid& grid, BrickRing& ring)
    : grid_(grid), ring_(ring), marked_(grid.brick_count()), queue_(grid.brick_count()) {}

void BrickSender::mark(uint32_t brick) noexcept {
  if (marked_[brick]) return;
  marked_[brick] = 1;
  queue_[(head_ + count_) % queue_.size()] = brick;
  ++count_;
}

void BrickSender::send(const uint8_t* coverage, uint32_t tick, int budget) noexcept {
  BrickImage image;
  for (; budget > 0 && count_ > 0; --budget) {
    image.brick = queue_[head_];
    image.tick = tick;
    read_brick(grid_, coverage, image.brick, image.coverage);
    if (!ring_.try_push(image)) return;
    marked_[image.brick] = 0;
    head_ = (head_ + 1) % queue_.size();
    --count_;
  }
}

}  // namespace ream::voxel
