#pragma once
#include <memory>
#include <string>
#include <vector>

#include "record/recorded_bone.hpp"
#include "voxel/bricks.hpp"

namespace ream::record {

inline constexpr uint32_t ticks_per_chunk = 250;  ///< a chunk is a quarter of a second
inline constexpr uint32_t chunks_per_key = 64;    ///< keys of bricks every 16 s
inline constexpr double sync_interval_s = 1.0;    ///< fsync; a lost power supply costs no more

/// Writes recording.ream on a thread of its own. add() only hands over; a chunk of 250 ticks, the bricks that
/// they changed, and a checkpoint are encoded, compressed, appended and from time to time fsynced by the
/// thread. A failure (a full disk) stops the writing, not the caller: failure() says it, and what was written
/// before is whole. Used by one follower thread.
class Recorder {
 public:
  /// A new recording. `start_coverage` is read for bricks that change for the first time, when they are
  /// added: a follower's replica will do, if it takes brick images in after add().
  Recorder(std::unique_ptr<LogSink> sink, ops::Header header, ops::Segment segment,
           const voxel::VoxelGrid& grid, const uint8_t* start_coverage);
  /// Goes on with one that was read, after recording.tick_count() ticks. `bone` stands at its end.
  Recorder(std::unique_ptr<LogSink> sink, const Recording& recording, const RecordedBone& bone,
           ops::Segment segment, const uint8_t* start_coverage);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A changed brick. All images of ticks up to t must have been added before tick t is.
  void add(const voxel::BrickImage& image);
  void add(const ops::Tick& tick);
  void add(ops::Event event);
  void add(ops::Annotation annotation);
  /// Writes what is pending and the end, and waits for it. Throws Error io when that or anything before
  /// failed.
  void finish(const std::string& state);
  /// One sentence when writing has failed; else empty. From any thread.
  std::string failure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ream::record
