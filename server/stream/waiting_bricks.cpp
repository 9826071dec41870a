#include "stream/waiting_bricks.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/vector_clones.hpp"

namespace ream::stream {
namespace {

REAM_VECTOR_CLONES int largest_difference(const uint8_t* a, const uint8_t* b) {
  uint8_t largest = 0;
  for (int i = 0; i < voxel::brick_voxels; ++i) {
    const auto difference = static_cast<uint8_t>(std::max(a[i], b[i]) - std::min(a[i], b[i]));
    largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace

VoxelBox difference_box(const uint8_t* a, const uint8_t* b) {
  constexpr int edge = voxel::brick_edge;
  VoxelBox box{Vec3i::Constant(edge), Vec3i::Constant(-1)};
  uint64_t columns = 0;  // byte x is not 0 where any row differs at x
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y, a += edge, b += edge) {
      uint64_t row_a, row_b;
      std::memcpy(&row_a, a, edge);
      std::memcpy(&row_b, b, edge);
      if (row_a == row_b) continue;
      columns |= row_a ^ row_b;
      box.low = box.low.cwiseMin(Vec3i(edge, y, z));
      box.high = box.high.cwiseMax(Vec3i(-1, y, z));
    }
  box.low.x() = std::countr_zero(columns) / 8;
  box.high.x() = edge - 1 - std::countl_zero(columns) / 8;
  return box;
}

void WaitingBricks::put(const voxel::BrickImage& image, const uint8_t* shown, int64_t now_ns) {
  const int moved = largest_difference(shown, image.coverage);
  const auto known = place_.find(image.brick);
  if (known == place_.end()) {
    if (moved == 0) return;
    if (images_.empty()) since_ns_ = now_ns;
    place_.emplace(image.brick, images_.size());
    images_.push_back(image);
  } else {
    images_[known->second] = image;
  }
  most_moved_ = std::max(most_moved_, moved);
  newest_tick_ = std::max(newest_tick_, image.tick);
}

void WaitingBricks::clear() {
  images_.clear();
  place_.clear();
  most_moved_ = 0;
  newest_tick_ = 0;
}

}  // namespace ream::stream
