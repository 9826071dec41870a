#include "record/chunk_encoder.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "record/recorder.hpp"

namespace ream::record {

ChunkEncoder::ChunkEncoder(uint64_t grid_hash, BrickCoverages changed, BrickCoverages starts)
    : grid_hash_(grid_hash), now_(std::move(changed)), start_(std::move(starts)) {}

void ChunkEncoder::encode(ChunkContents contents, OpLogWriter& writer) {
  for (const Note& note : contents.notes) std::visit([&](const auto& op) { writer.add(op); }, note);
  if (contents.rows.empty()) return;
  for (const ops::Tick& row : contents.rows) writer.add(row);
  const ops::Tick& last = contents.rows.back();
  add_bricks(contents.bricks, last.tick, writer);
  if (++chunks_ % chunks_per_key == 0) add_key(last.tick, writer);
  if (contents.bone_is_whole) writer.add(ops::Checkpoint{last.tick, last.session_hash, grid_hash_});
}

void ChunkEncoder::add_bricks(std::vector<ChangedBrick>& bricks, uint32_t tick, OpLogWriter& writer) {
  std::map<uint32_t, const voxel::BrickImage*> newest;
  for (ChangedBrick& brick : bricks) {
    newest[brick.now.brick] = &brick.now;
    if (!brick.start) continue;
    start_.emplace(brick.now.brick, *brick.start);
    now_.emplace(brick.now.brick, *brick.start);
  }
  BrickDeltaWriter deltas;
  for (const auto& [index, image] : newest) {
    uint8_t* before = now_.at(index).level;
    if (std::memcmp(before, image->coverage, voxel::brick_voxels) == 0) continue;
    deltas.add(index, before, image->coverage);
    grid_hash_ += voxel::brick_hash(index, image->coverage) - voxel::brick_hash(index, before);
    std::memcpy(before, image->coverage, voxel::brick_voxels);
  }
  if (const uint32_t count = deltas.count(); count > 0)
    writer.add(ops::Bricks{tick, 0, count, deltas.take()});
}

void ChunkEncoder::add_key(uint32_t tick, OpLogWriter& writer) const {
  std::vector<uint32_t> indices;
  for (const auto& [index, coverage] : now_) indices.push_back(index);
  std::sort(indices.begin(), indices.end());
  BrickDeltaWriter deltas;
  for (const uint32_t index : indices) deltas.add(index, start_.at(index).level, now_.at(index).level);
  const uint32_t count = deltas.count();
  writer.add(ops::Bricks{tick, 1, count, deltas.take()});
}

}  // namespace ream::record
