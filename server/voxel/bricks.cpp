#include "voxel/bricks.hpp"

namespace ream::voxel {

void read_brick(const VoxelGrid& grid, const uint8_t* coverage, uint32_t brick, uint8_t* image) noexcept {
  const uint8_t* base = coverage + grid.brick_base(brick);
  const size_t row = static_cast<size_t>(grid.dims.x()), slice = row * static_cast<size_t>(grid.dims.y());
  for (size_t w = 0; w < brick_edge; ++w)
    for (size_t v = 0; v < brick_edge; ++v, image += brick_edge)
      std::memcpy(image, base + w * slice + v * row, brick_edge);
}

void write_brick(const VoxelGrid& grid, uint8_t* coverage, uint32_t brick, const uint8_t* image) noexcept {
  uint8_t* base = coverage + grid.brick_base(brick);
  const size_t row = static_cast<size_t>(grid.dims.x()), slice = row * static_cast<size_t>(grid.dims.y());
  for (size_t w = 0; w < brick_edge; ++w)
    for (size_t v = 0; v < brick_edge; ++v, image += brick_edge)
      std::memcpy(base + w * slice + v * row, image, brick_edge);
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
