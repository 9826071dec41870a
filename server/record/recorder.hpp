#pragma once
#include <memory>
#include <string>

#include "record/op_log.hpp"
#include "record/recorded_bone.hpp"
#include "voxel/bricks.hpp"

namespace ream::record {

inline constexpr uint32_t ticks_per_chunk = 250;  ///< a chunk is a quarter of a second
inline constexpr uint32_t chunks_per_key = 64;    ///< keys of bricks every 16 s
inline constexpr double sync_interval_s = 1.0;    ///< fsync; a loss of power costs no more
/// Rows of a chunk while brick images are behind; such a chunk has no checkpoint, and the bone of its moment
/// is not quite what it was.
inline constexpr uint32_t max_ticks_per_chunk = 4 * ticks_per_chunk;
inline constexpr size_t max_waiting_bytes = size_t{512} << 20;  ///< a disk that is later has failed

/// Writes recording.ream on a thread of its own. add() only hands over; a chunk of 250 ticks (a few more
/// while brick images are behind), the bricks that they changed, and a checkpoint are encoded, compressed and
/// appended by the thread; a second one fsyncs from time to time, while the first goes on. A failure (a full
/// disk) stops the writing, not the caller: failure() says it, and what was written before is whole. Used by
/// one follower thread.
class Recorder {
 public:
  /// A new recording, which can be read from here on. `start_coverage` is read for bricks that change for the
  /// first time, when they are added: a follower's replica will do, if it takes brick images in after add().
  /// Throws Error io.
  Recorder(std::unique_ptr<LogSink> sink, const ops::Header& header, const ops::Segment& segment,
           const uint8_t* start_coverage);
  /// Goes on with one that was read, after recording.tick_count() ticks; `sink` continues its whole bytes.
  /// `bone` stands at its end; of bricks that it has changed start_coverage is not read.
  Recorder(std::unique_ptr<LogSink> sink, const Recording& recording, const RecordedBone& bone,
           const ops::Segment& segment, const uint8_t* start_coverage);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A changed brick. All images sent up to tick t must have been added before t's report is.
  void add(const voxel::BrickImage& image);
  void add(const TickReport& report);
  void add(const ops::Event& event);
  void add(const ops::Annotation& annotation);
  /// Writes what is pending and the end, and waits for it. Throws Error io when that or anything before
  /// failed.
  void finish(const std::string& state);

  /// One sentence when writing has failed; else empty. From any thread.
  std::string failure() const;
  /// Chunks that the thread has not written yet: who may wait, waits while it is more than a few.
  size_t waiting_chunks() const;
  /// Processor time of the thread so far, and bytes written. From any thread.
  double cpu_s() const;
  uint64_t bytes_written() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ream::record
