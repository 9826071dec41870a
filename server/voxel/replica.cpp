#include "voxel/replica.hpp"

#include <algorithm>
#include <utility>

namespace ream::voxel {

Replica::Replica(const BoneModel& bone)
    : grid_(bone.grid),
      coverage_(bone.coverage),
      block_dims_((bone.grid.dims.array() + (block_edge - 1)).matrix() / block_edge),
      dirty_(static_cast<size_t>(block_dims_.prod())) {}

void Replica::apply(const BrickImage& image) {
  write_brick(grid_, coverage_.data(), image.brick, image.coverage);
  mark_around(grid_.brick_coordinates(image.brick));
}

Vec3i Replica::block_coordinates(uint32_t block) const {
  const int i = static_cast<int>(block);
  return {i % block_dims_.x(), (i / block_dims_.x()) % block_dims_.y(),
          i / (block_dims_.x() * block_dims_.y())};
}

std::vector<uint32_t> Replica::take_dirty_blocks() {
  for (const uint32_t block : dirty_list_) dirty_[block] = 0;
  return std::exchange(dirty_list_, {});
}

void Replica::mark_around(const Vec3i& brick) {
  constexpr int reach = 2;
  const Vec3i low = (brick * brick_edge).array() - reach;
  const Vec3i high = (brick * brick_edge).array() + (brick_edge - 1 + reach);
  const auto block_of = [&](const Vec3i& voxel) -> Vec3i {
    return voxel.cwiseMax(0).cwiseMin(grid_.dims - Vec3i::Ones()) / block_edge;
  };
  const Vec3i first = block_of(low), last = block_of(high);
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const auto block = static_cast<uint32_t>(x + block_dims_.x() * (y + block_dims_.y() * z));
        if (std::exchange(dirty_[block], uint8_t{1}) == 0) dirty_list_.push_back(block);
      }
}

}  // namespace ream::voxel
