#pragma once
#include <vector>

#include "voxel/bricks.hpp"

namespace ream::voxel {

/// Edge of a surface block in voxels (4 bricks).
inline constexpr int block_edge = 32;

/// A follower's own copy of the coverage, kept up to date from brick images. Owned by one thread. Remembers
/// which 32^3 surface blocks must be extracted again: a voxel at a block's border also touches its
/// neighbours' surface (cells and gradients reach two voxels out).
class Replica {
 public:
  /// Copies the coverage as it is before the first tick.
  explicit Replica(const BoneModel& bone);

  void apply(const BrickImage& image);

  const VoxelGrid& grid() const { return grid_; }
  const std::vector<uint8_t>& coverage() const { return coverage_; }

  Vec3i block_dims() const { return block_dims_; }
  size_t block_count() const { return dirty_.size(); }
  Vec3i block_coordinates(uint32_t block) const;
  /// Blocks touched since the last call, in order of first touch; clears the marks.
  std::vector<uint32_t> take_dirty_blocks();

 private:
  void mark_around(const Vec3i& brick);

  VoxelGrid grid_;
  std::vector<uint8_t> coverage_;
  Vec3i block_dims_;
  std::vector<uint8_t> dirty_;
  std::vector<uint32_t> dirty_list_;
};

}  // namespace ream::voxel
