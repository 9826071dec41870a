#include "record/recorder.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <ctime>
#include <deque>
#include <map>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <unordered_set>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/signal_handlers.hpp"
#include "record/brick_deltas.hpp"

namespace ream::record {
namespace {

constexpr int recorder_nice = 10;
constexpr auto sync_interval =
    std::chrono::duration_cast<SteadyClock::duration>(std::chrono::duration<double>(sync_interval_s));

double thread_cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

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

BrickCoverages starts_of(const BrickCoverages& changed, const RecordedBone& bone) {
  BrickCoverages starts;
  for (const auto& [brick, now] : changed)
    std::memcpy(starts[brick].level, bone.start_of(brick), voxel::brick_voxels);
  return starts;
}

}  // namespace

/// The two threads and what they share with the follower.
struct Recorder::Impl {
  Impl(OpLogWriter log, ChunkEncoder bricks, const uint8_t* start)
      : writer(std::move(log)), encoder(std::move(bricks)), start_coverage(start) {}

  ~Impl() {
    {
      const std::lock_guard lock(mutex);
      leaving = true;
    }
    stop_threads();
  }

  /// After `leaving` was set: what waits is written; a sync that is due no more.
  void stop_threads() {
    wake.notify_one();
    written.notify_one();
    if (thread.joinable()) thread.join();
    if (sync_thread.joinable()) sync_thread.join();
  }

  void begin(const ops::Segment& segment, const ops::Header* header) {
    if (header != nullptr) writer.add(*header);
    writer.add(segment);
    writer.close_chunk();
    writer.sync();
    bytes_written = writer.bytes_written();
    sync_thread = start_thread([this] { sync_in_time(); });
    thread = start_thread([this] { write_chunks(); });
  }

  void write_chunks() {
    // On Linux of this thread only. It is never in a hurry, others are; if refused it stays as it is.
    ::setpriority(PRIO_PROCESS, 0, recorder_nice);
    for (;;) {
      ChunkContents contents;
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [this] { return leaving || !queue.empty(); });
        if (queue.empty()) return;
        queued_bytes -= queue.front().bytes();
        contents = std::move(queue.front());
        queue.pop_front();
        ++in_hand;
      }
      if (!failed) try {
          write(std::move(contents));
        } catch (const std::exception& e) {
          fail(e.what());
        }
      cpu_s = thread_cpu_s();
      {
        const std::lock_guard lock(mutex);
        --in_hand;
      }
      done.notify_all();
    }
  }

  void write(ChunkContents contents) {
    encoder.encode(std::move(contents), writer);
    writer.close_chunk();
    bytes_written = writer.bytes_written();
    {
      const std::lock_guard lock(mutex);
      if (!unsynced) sync_due = SteadyClock::now() + sync_interval;
      unsynced = true;
    }
    written.notify_one();
  }

  /// A thread of its own: on a busy disk a sync takes seconds, and chunks must be in the file meanwhile,
  /// where the end of the program does not reach them.
  void sync_in_time() {
    ::setpriority(PRIO_PROCESS, 0, recorder_nice);
    std::unique_lock lock(mutex);
    for (;;) {
      written.wait(lock, [this] { return leaving || unsynced; });
      if (written.wait_until(lock, sync_due, [this] { return leaving; }) || leaving) return;
      unsynced = false;
      lock.unlock();
      if (!failed) sync();
      lock.lock();
    }
  }

  void sync() {
    try {
      writer.sync();
    } catch (const std::exception& e) {
      fail(e.what());
    }
  }

  void fail(const std::string& why) {
    const std::lock_guard lock(mutex);
    if (words.empty()) words = why;
    failed = true;
  }

  void hand_over(ChunkContents contents) {
    {
      const std::lock_guard lock(mutex);
      if (queued_bytes > max_waiting_bytes && words.empty()) {
        words = "the disk is too far behind the recording";
        failed = true;
      }
      if (!failed) {
        queued_bytes += contents.bytes();
        queue.push_back(std::move(contents));
      }
    }
    wake.notify_one();
  }

  /// Bricks of images up to the last row's tick, oldest first.
  void close_chunk() {
    if (open_chunk.rows.empty() && open_chunk.notes.empty()) return;
    std::unordered_map<uint32_t, size_t> place;
    while (!open_chunk.rows.empty() && !images.empty() &&
           images.front().now.tick <= open_chunk.rows.back().tick) {
      take_newest(std::move(images.front()), place);
      images.pop_front();
    }
    open_chunk.bone_is_whole = bricks_waiting == 0 || rest_was_sent();
    hand_over(std::move(open_chunk));
    open_chunk = {};
  }

  /// Of each brick only the last image counts; what it was at the start came with the first.
  void take_newest(ChangedBrick&& brick, std::unordered_map<uint32_t, size_t>& place) {
    const auto [at, first] = place.try_emplace(brick.now.brick, open_chunk.bricks.size());
    if (first)
      open_chunk.bricks.push_back(std::move(brick));
    else
      open_chunk.bricks[at->second].now = brick.now;
  }

  /// The images that had to wait came after the loop ended, in the name of the last tick.
  bool rest_was_sent() const { return finishing && images.empty(); }

  // The thread's.
  OpLogWriter writer;  ///< but for its sync()
  ChunkEncoder encoder;

  // The follower's.
  const uint8_t* start_coverage;
  ChunkContents open_chunk;
  uint32_t next_tick = 0;
  uint32_t bricks_waiting = 0;  ///< after the last row
  bool finishing = false;
  std::deque<ChangedBrick> images;     ///< not yet in a chunk
  std::unordered_set<uint32_t> known;  ///< bricks whose start the encoder has

  // Of all.
  mutable std::mutex mutex;
  std::condition_variable wake, written, done;
  std::deque<ChunkContents> queue;
  size_t in_hand = 0, queued_bytes = 0;
  bool leaving = false;
  bool unsynced = false;             ///< something was written since the last sync began
  SteadyClock::time_point sync_due;  ///< when it was, of that
  std::string words;
  std::atomic<bool> failed{false};
  std::atomic<double> cpu_s{0.0};
  std::atomic<uint64_t> bytes_written{0};
  std::thread thread, sync_thread;
};

Recorder::Recorder(std::unique_ptr<LogSink> sink, const ops::Header& header, const ops::Segment& segment,
                   const uint8_t* start_coverage)
    : impl_(std::make_unique<Impl>(OpLogWriter(std::move(sink)), ChunkEncoder(header.start_grid_hash, {}, {}),
                                   start_coverage)) {
  impl_->begin(segment, &header);
}

Recorder::Recorder(std::unique_ptr<LogSink> sink, const Recording& recording, const RecordedBone& bone,
                   const ops::Segment& segment, const uint8_t* start_coverage)
    : impl_(std::make_unique<Impl>(
          OpLogWriter(std::move(sink), recording.log().chain()),
          ChunkEncoder(bone.coverage_hash(), bone.changed(), starts_of(bone.changed(), bone)),
          start_coverage)) {
  for (const auto& [brick, now] : bone.changed()) impl_->known.insert(brick);
  impl_->next_tick = recording.tick_count();
  impl_->begin(segment, nullptr);
}

/// What was not finished is kept as far as it goes, without an end.
Recorder::~Recorder() {
  try {
    impl_->close_chunk();
  } catch (const std::exception& e) {
    impl_->fail(e.what());
  }
}

void Recorder::add(const voxel::BrickImage& image) {
  if (impl_->failed) return;
  ChangedBrick changed{image, nullptr};
  if (impl_->known.insert(image.brick).second) {
    changed.start = std::make_unique<BrickCoverage>();
    std::memcpy(changed.start->level, impl_->start_coverage + size_t{image.brick} * voxel::brick_voxels,
                voxel::brick_voxels);
  }
  impl_->images.push_back(std::move(changed));
}

void Recorder::add(const TickReport& report) {
  if (impl_->failed) return;
  impl_->open_chunk.rows.push_back(tick_op(report));
  impl_->next_tick = report.tick + 1;
  impl_->bricks_waiting = report.bricks_waiting;
  const size_t rows = impl_->open_chunk.rows.size();
  if (rows >= ticks_per_chunk && (report.bricks_waiting == 0 || rows >= max_ticks_per_chunk))
    impl_->close_chunk();
}

void Recorder::add(const ops::Event& event) { impl_->open_chunk.notes.emplace_back(event); }

void Recorder::add(const ops::Annotation& annotation) { impl_->open_chunk.notes.emplace_back(annotation); }

void Recorder::finish(const std::string& state) {
  Impl& impl = *impl_;
  const uint32_t ticks = impl.next_tick;
  impl.finishing = true;
  impl.close_chunk();
  impl.open_chunk.notes.emplace_back(ops::End{ticks, state});
  impl.close_chunk();
  {
    std::unique_lock lock(impl.mutex);
    impl.done.wait(lock, [&] { return impl.queue.empty() && impl.in_hand == 0; });
    impl.leaving = true;
  }
  impl.stop_threads();
  if (!impl.failed) impl.sync();
  if (impl.failed) throw Error(ErrorKind::io, failure());
}

std::string Recorder::failure() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->words;
}

size_t Recorder::waiting_chunks() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->queue.size() + impl_->in_hand;
}

double Recorder::cpu_s() const { return impl_->cpu_s; }

uint64_t Recorder::bytes_written() const { return impl_->bytes_written; }

}  // namespace ream::record
