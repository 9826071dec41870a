#pragma once
#include <memory>
#include <vector>

#include "record/brick_deltas.hpp"
#include "record/note.hpp"
#include "record/op_log.hpp"
#include "voxel/bricks.hpp"

namespace ream::record {

/// A changed brick on its way into a chunk.
struct ChangedBrick {
  voxel::BrickImage now;
  std::unique_ptr<BrickCoverage> start;  ///< set when the recording has not had this brick yet
};

/// What becomes one chunk.
struct ChunkContents {
  std::vector<ops::Tick> rows;
  std::vector<ChangedBrick> bricks;  ///< each brick once
  bool bone_is_whole = true;         ///< with them a reader has the bone after the last row
  std::vector<Note> notes;

  /// Memory, roughly.
  size_t bytes() const {
    return rows.size() * sizeof(ops::Tick) + bricks.size() * (sizeof(ChangedBrick) + sizeof(BrickCoverage));
  }
};

/// Turns the contents of chunks into ops: keeps what a reader knows of each brick and the hash of the whole
/// grid. Used by the recorder's thread.
class ChunkEncoder {
 public:
  /// `grid_hash`: of the coverage now. `changed` and `starts`: bricks that differ from the start already, and
  /// what they were at the start.
  ChunkEncoder(uint64_t grid_hash, BrickCoverages changed, BrickCoverages starts);

  /// Adds ops to the writer's open chunk; every chunks_per_key-th time a key of bricks as well.
  void encode(ChunkContents contents, OpLogWriter& writer);

 private:
  void add_bricks(std::vector<ChangedBrick>& bricks, uint32_t tick, OpLogWriter& writer);
  void add_key(uint32_t tick, OpLogWriter& writer) const;

  uint64_t grid_hash_;
  BrickCoverages now_, start_;  ///< the same bricks in both
  uint32_t chunks_ = 0;
};

}  // namespace ream::record
