#include "voxel/bricks.hpp"

#include <cassert>
#include <cstring>

#include "core/hash.hpp"

namespace ream::voxel {
namespace {

/// Calls visit(place in brick order, place in row order) for every run of brick_edge voxels along x.
template <typename Visit>
void each_run(const VoxelGrid& grid, Visit visit) {
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); u += brick_edge) visit(grid.index(u, v, w), grid.row_index(u, v, w));
}

}  // namespace

std::vector<uint8_t> bricks_from_rows(const VoxelGrid& grid, std::span<const uint8_t> rows) {
  assert(rows.size() == grid.voxel_count());
  std::vector<uint8_t> bricks(rows.size());
  each_run(grid, [&](size_t brick, size_t row) { std::memcpy(&bricks[brick], &rows[row], brick_edge); });
  return bricks;
}

std::vector<uint8_t> rows_from_bricks(const VoxelGrid& grid, std::span<const uint8_t> bricks) {
  assert(bricks.size() == grid.voxel_count());
  std::vector<uint8_t> rows(bricks.size());
  each_run(grid, [&](size_t brick, size_t row) { std::memcpy(&rows[row], &bricks[brick], brick_edge); });
  return rows;
}

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
