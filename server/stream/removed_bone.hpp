#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "surface/removed_share.hpp"
#include "voxel/bricks.hpp"

namespace ream::stream {

/// Tells how much bone is gone at places of a surface since before the first tick (surface::removed_level),
/// so that viewers can paint what was cut. Keeps memory for bricks that have changed only. Used by one
/// thread.
class RemovedBone {
 public:
  static constexpr int max_level = 15;  ///< half a voxel under the first surface or more

  /// `now` has grid.voxel_count() bytes in the order of VoxelGrid::index, and outlives this.
  RemovedBone(const voxel::VoxelGrid& grid, const std::vector<uint8_t>& now);
  explicit RemovedBone(const voxel::Replica& now) : RemovedBone(now.grid(), now.coverage()) {}

  /// A brick as it was before its first change, brick_voxels bytes; of a brick that is known nothing changes.
  void keep(uint32_t brick, const uint8_t* before);
  /// What was kept of it; null: nothing. Until the next keep().
  const uint8_t* kept(uint32_t brick) const;

  /// Of vertices of `block` (as surface::BlockLayout numbers them), one each; empty where nothing is gone.
  std::vector<uint8_t> levels(std::span<const surface::BlockVertex> vertices, uint32_t block) const;
  /// Levels as MeshBlock.removed of proto/stream.fbs: 4 bits each, the first in the lowest.
  static std::vector<uint8_t> packed(std::span<const uint8_t> levels);

 private:
  surface::TwoCoverages sample_at(const Vec3i& voxel) const;

  const voxel::VoxelGrid grid_;
  const std::vector<uint8_t>& now_;
  surface::BlockLayout layout_;
  std::vector<uint32_t> place_;  ///< per brick: one more than its place in before_, 0 where it is not kept
  std::vector<uint8_t> before_;
};

}  // namespace ream::stream
