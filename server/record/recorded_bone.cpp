#include "record/recorded_bone.hpp"

#include <cstring>
#include <exception>

#include "core/error.hpp"

namespace ream::record {
RecordedBone::RecordedBone(const Recording& recording, const voxel::VoxelGrid& grid,
                           std::span<const uint8_t> start_coverage)
    : recording_(recording), grid_(grid), start_(start_coverage), hash_(recording.header().start_grid_hash) {}

const uint8_t* RecordedBone::now(uint32_t brick) const {
  const auto found = changed_.find(brick);
  return found == changed_.end() ? start_of(brick) : found->second.level;
}

void RecordedBone::back_to_start() {
  for (const auto& [brick, coverage] : changed_) touched_.try_emplace(brick, coverage);
  changed_.clear();
  hash_ = recording_.header().start_grid_hash;
  next_chunk_ = 0;
  ticks_ = 0;
}

void RecordedBone::apply(uint32_t brick, const uint8_t* falls, bool from_key) {
  BrickCoverage next;
  const uint8_t* before = from_key ? start_of(brick) : now(brick);
  for (size_t i = 0; i < voxel::brick_voxels; ++i) next.level[i] = static_cast<uint8_t>(before[i] - falls[i]);
  hash_ += voxel::brick_hash(brick, next.level) - voxel::brick_hash(brick, now(brick));
  const auto [old, first_touch] = touched_.try_emplace(brick);
  if (first_touch) std::memcpy(old->second.level, now(brick), voxel::brick_voxels);
  changed_[brick] = next;
}

void RecordedBone::apply_chunk(size_t chunk, bool from_key) {
  const auto take = [&](const ops::Bricks& op) {
    if ((op.key != 0) != from_key) return;
    read_brick_deltas(op, grid_.brick_count(),
                      [&](uint32_t brick, const uint8_t* falls) { apply(brick, falls, from_key); });
  };
  const OpLogReader& log = recording_.log();
  ops::read(log.read_chunk(chunk), log.revision(), take);
  const ChunkPlace& place = log.chunks()[chunk];
  next_chunk_ = chunk + 1;
  if (place.ticks > 0) ticks_ = place.first_tick + place.ticks;
}

/// The newest chunk with a key up to `chunk`; chunks().size() when there is none.
size_t RecordedBone::key_at_or_before(size_t chunk) const {
  const std::vector<ChunkPlace>& chunks = recording_.log().chunks();
  for (size_t i = chunk + 1; i-- > 0;)
    if (chunks[i].has_key) return i;
  return chunks.size();
}

void RecordedBone::seek(uint32_t ticks, const std::function<void(const voxel::BrickImage&)>& visit) {
  const std::vector<ChunkPlace>& chunks = recording_.log().chunks();
  size_t target = 0;  // all chunks before it are wanted
  for (size_t i = 0; i < chunks.size(); ++i)
    if (chunks[i].ticks > 0 && chunks[i].first_tick + chunks[i].ticks <= ticks) target = i + 1;
  touched_.clear();
  std::exception_ptr damaged;
  try {
    const size_t key = target > 0 ? key_at_or_before(target - 1) : chunks.size();
    if (target < next_chunk_ || (key < chunks.size() && key > next_chunk_)) {
      back_to_start();
      if (key < chunks.size()) apply_chunk(key, true);
    }
    while (next_chunk_ < target) apply_chunk(next_chunk_, false);
  } catch (const Error&) {
    damaged = std::current_exception();
  }
  for (const auto& [brick, was] : touched_) {
    if (std::memcmp(was.level, now(brick), voxel::brick_voxels) == 0) continue;
    voxel::BrickImage image;
    image.brick = brick;
    image.tick = ticks_;
    std::memcpy(image.coverage, now(brick), voxel::brick_voxels);
    visit(image);
  }
  if (damaged) std::rethrow_exception(damaged);
}

void RecordedBone::write_to(std::span<uint8_t> coverage) const {
  for (const auto& [brick, now] : changed_)
    std::memcpy(coverage.data() + size_t{brick} * voxel::brick_voxels, now.level, voxel::brick_voxels);
}

}  // namespace ream::record
