#pragma once
#include <functional>
#include <span>
#include <unordered_map>

#include "record/recording.hpp"
#include "voxel/bricks.hpp"

namespace ream::record {

/// The bone of a recording at any moment, by brick deltas alone. Moments are the ends of chunks, a quarter of
/// a second apart. Memory for changed bricks only. Used by one thread.
class RecordedBone {
 public:
  /// `start_coverage`: of the whole grid before tick 0 (pilot hole gone); it and the recording outlive this.
  RecordedBone(const Recording& recording, const voxel::VoxelGrid& grid,
               std::span<const uint8_t> start_coverage);

  /// Goes to the last moment at or before `ticks` ticks have passed, forwards or backwards, and tells every
  /// brick that now differs from what it was before the call. Error invalid_input for a damaged chunk.
  void seek(uint32_t ticks, const std::function<void(const voxel::BrickImage&)>& told);
  /// Ticks that have passed at this moment.
  uint32_t ticks() const { return ticks_; }
  /// Of the whole coverage at this moment, from the start's hash on; equals BoneModel::coverage_hash().
  uint64_t coverage_hash() const { return hash_; }
  /// Writes the changed bricks into a copy of the start's coverage.
  void write_to(std::span<uint8_t> coverage) const;

 private:
  struct Image {
    uint8_t coverage[voxel::brick_voxels];
  };
  using Images = std::unordered_map<uint32_t, Image>;

  const Recording& recording_;
  const voxel::VoxelGrid grid_;
  std::span<const uint8_t> start_;
  Images images_;  ///< bricks that differ from the start
  uint32_t ticks_ = 0;
  uint64_t start_hash_ = 0, hash_ = 0;
};

}  // namespace ream::record
