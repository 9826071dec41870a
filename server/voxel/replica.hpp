#pragma once
#include <vector>

#include "voxel/bricks.hpp"

namespace ream::voxel {

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
