#include "record/recorder.hpp"

#include <atomic>
#include <condition_variable>
#include <cstring>
#include <ctime>
#include <deque>
#include <mutex>
#include <thread>
#include <unordered_set>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "record/chunk_encoder.hpp"

namespace ream::record {
namespace {

double thread_cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

BrickCoverages starts_of(const BrickCoverages& changed, const RecordedBone& bone) {
  BrickCoverages starts;
  for (const auto& [brick, now] : changed)
    std::memcpy(starts[brick].level, bone.start_of(brick), voxel::brick_voxels);
  return starts;
}

}  // namespace

/// The thread and what it shares with the follower.
struct Recorder::Impl {
  Impl(OpLogWriter log, ChunkEncoder bricks, const uint8_t* start)
      : writer(std::move(log)), encoder(std::move(bricks)), start_coverage(start) {}

  ~Impl() {
    {
      const std::lock_guard lock(mutex);
      leaving = true;
    }
    wake.notify_one();
    if (thread.joinable()) thread.join();
  }

  void begin(const ops::Segment& segment, const ops::Header* header) {
    if (header != nullptr) writer.add(*header);
    writer.add(segment);
    writer.close_chunk();
    writer.sync();
    bytes_written = writer.bytes_written();
    thread = std::thread([this] { write_chunks(); });
  }

  void write_chunks() {
    for (;;) {
      ChunkContents contents;
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [this] { return leaving || !queue.empty(); });
        if (queue.empty()) return;
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
    const int64_t now_ns = steady_ns();
    if (static_cast<double>(now_ns - synced_ns) * 1e-9 < sync_interval_s) return;
    writer.sync();
    synced_ns = now_ns;
  }

  void fail(const std::string& why) {
    const std::lock_guard lock(mutex);
    if (words.empty()) words = why;
    failed = true;
  }

  void hand_over(ChunkContents contents) {
    {
      const std::lock_guard lock(mutex);
      if (queue.size() >= most_waiting_chunks && words.empty()) {
        words = "the disk is more than a minute behind the recording";
        failed = true;
      }
      if (!failed) queue.push_back(std::move(contents));
    }
    wake.notify_one();
  }

  /// Bricks of images up to the last row's tick, oldest first.
  void close_chunk() {
    if (open_chunk.rows.empty() && open_chunk.notes.empty()) return;
    while (!open_chunk.rows.empty() && !images.empty() &&
           images.front().now.tick <= open_chunk.rows.back().tick) {
      open_chunk.bricks.push_back(std::move(images.front()));
      images.pop_front();
    }
    hand_over(std::move(open_chunk));
    open_chunk = {};
  }

  // The thread's.
  OpLogWriter writer;
  ChunkEncoder encoder;
  int64_t synced_ns = steady_ns();

  // The follower's.
  const uint8_t* start_coverage;
  ChunkContents open_chunk;
  uint32_t next_tick = 0;
  std::deque<ChangedBrick> images;     ///< not yet in a chunk
  std::unordered_set<uint32_t> known;  ///< bricks whose start the encoder has

  // Of both.
  mutable std::mutex mutex;
  std::condition_variable wake, done;
  std::deque<ChunkContents> queue;
  size_t in_hand = 0;
  bool leaving = false;
  std::string words;
  std::atomic<bool> failed{false};
  std::atomic<double> cpu_s{0.0};
  std::atomic<uint64_t> bytes_written{0};
  std::thread thread;
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

Recorder::~Recorder() = default;

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
  if (impl_->open_chunk.rows.size() >= ticks_per_chunk && report.bricks_waiting == 0) impl_->close_chunk();
}

void Recorder::add(const ops::Event& event) { impl_->open_chunk.notes.emplace_back(event); }

void Recorder::add(const ops::Annotation& annotation) { impl_->open_chunk.notes.emplace_back(annotation); }

void Recorder::finish(const std::string& state) {
  Impl& impl = *impl_;
  const uint32_t ticks = impl.next_tick;
  impl.close_chunk();
  impl.open_chunk.notes.emplace_back(ops::End{ticks, state});
  impl.close_chunk();
  {
    std::unique_lock lock(impl.mutex);
    impl.done.wait(lock, [&] { return impl.queue.empty() && impl.in_hand == 0; });
    impl.leaving = true;
  }
  impl.wake.notify_one();
  impl.thread.join();
  if (!impl.failed) try {
      impl.writer.sync();
    } catch (const Error& e) {
      impl.fail(e.what());
    }
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
