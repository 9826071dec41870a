#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "voxel/bricks.hpp"

namespace ream::stream {

/// Voxels of a brick, low to high along each axis.
struct VoxelBox {
  Vec3i low, high;
};

/// The box around the voxels, at least one, in which two images of a brick differ; within the brick.
VoxelBox difference_box(const uint8_t* a, const uint8_t* b);

/// Newest images of bricks whose change viewers have not been shown yet, each brick once. Takes memory for
/// those only.
class WaitingBricks {
 public:
  /// `shown` is what viewers hold of that brick, brick_voxels bytes. An image that equals it is not kept.
  void put(const voxel::BrickImage& image, const uint8_t* shown, int64_t now_ns);
  void clear();

  bool empty() const { return images_.empty(); }
  const std::vector<voxel::BrickImage>& images() const { return images_; }
  /// Of them; in a replay it may be earlier than what is shown.
  uint32_t newest_tick() const { return newest_tick_; }
  /// Coverage levels by which any voxel differed from what is shown, at most.
  int most_moved() const { return most_moved_; }
  /// When the first of them was put.
  int64_t since_ns() const { return since_ns_; }

 private:
  std::vector<voxel::BrickImage> images_;
  std::unordered_map<uint32_t, size_t> place_;
  int most_moved_ = 0;
  uint32_t newest_tick_ = 0;
  int64_t since_ns_ = 0;
};

}  // namespace ream::stream
