#pragma once
#include <functional>
#include <span>

#include "record/brick_deltas.hpp"
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
  /// brick that now differs from what it was before the call. Error invalid_input for a damaged chunk; then
  /// it stands at the last whole moment on the way, told as always.
  void seek(uint32_t ticks, const std::function<void(const voxel::BrickImage&)>& visit);
  /// Ticks that have passed at this moment.
  uint32_t ticks() const { return ticks_; }
  /// Of the whole coverage at this moment, from the start's hash on; equals BoneModel::coverage_hash().
  uint64_t coverage_hash() const { return hash_; }
  /// Bricks that differ from the start at this moment.
  const BrickCoverages& changed() const { return changed_; }
  /// The brick before tick 0.
  const uint8_t* start_of(uint32_t brick) const {
    return start_.data() + size_t{brick} * voxel::brick_voxels;
  }
  /// Writes the changed bricks into a copy of the start's coverage.
  void write_to(std::span<uint8_t> coverage) const;

 private:
  size_t key_at_or_before(size_t chunk) const;
  void apply_chunk(size_t chunk, bool from_key);
  void apply(uint32_t brick, const uint8_t* falls, bool from_key);
  const uint8_t* now(uint32_t brick) const;
  void back_to_start();

  const Recording& recording_;
  const voxel::VoxelGrid grid_;
  std::span<const uint8_t> start_;
  BrickCoverages changed_;
  BrickCoverages touched_;  ///< by the seek in progress, as they were before it
  size_t next_chunk_ = 0;   ///< all before it are in
  uint32_t ticks_ = 0;
  uint64_t hash_ = 0;
};

}  // namespace ream::record
