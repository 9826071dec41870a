#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "stream/messages.hpp"

namespace ream::stream {

/// What a viewer in this process gets.
struct Parcel {
  std::vector<SharedBlock> blocks;  ///< the newest of each place
  SharedTelemetry newest;           ///< the last batch; null: none since the last time
  bool picture_complete = false;    ///< with these blocks, or before
};

/// What waits for one viewer, bounded however slow it is: at most one surface per block, always the newest,
/// and the latest telemetry; what telemetry was dropped is counted and told. Thread-safe.
class Mailbox {
 public:
  static constexpr size_t max_telemetry_batches =
      2'000'000'000 / telemetry_interval_ns;                ///< two seconds or a little more
  static constexpr size_t mesh_message_bytes = 256 * 1024;  ///< of the first whole picture
  /// Of what changes afterwards: telemetry, whose turn is next, is not kept waiting for long by a slow line.
  static constexpr size_t update_message_bytes = 16 * 1024;

  explicit Mailbox(std::function<void()> notify) : notify_(std::move(notify)) {}

  /// The viewer's side. The next message to send, null for nothing now: then `notify` is called once as soon
  /// as there is something again. Blocks are gathered to messages of about mesh_message_bytes or
  /// update_message_bytes; telemetry, as much as waits without a gap, and surface take turns.
  Message next();

  /// All that waits, for a viewer in this process: nothing is made into messages, hello and tool are left
  /// out, and `notify` is called for what comes later. Use either this or next().
  Parcel take();

  /// The fanout's side.
  void put_hello(Message hello);
  /// Goes before any telemetry that was put after it; the newest takes the place of one that still waits.
  void put_tool(Message change);
  void put_block(SharedBlock block);
  void put_telemetry(SharedTelemetry batch);
  /// The blocks put so far complete the first whole picture: the message with the last of them says so.
  void put_picture_complete();

 private:
  void wake(std::unique_lock<std::mutex> lock);
  Message next_telemetry();
  Message next_mesh();

  const std::function<void()> notify_;
  std::mutex mutex_;
  bool asleep_ = false;  ///< next() found nothing, notify is owed
  bool telemetry_had_its_turn_ = false;
  Message hello_, tool_;
  std::unordered_map<uint32_t, SharedBlock> newest_;
  std::deque<uint32_t> order_;  ///< keys of newest_, in order of first arrival
  enum class Picture { incomplete, sending, sent } picture_ = Picture::incomplete;
  size_t picture_blocks_left_ = 0;  ///< at the head of order_
  std::deque<SharedTelemetry> telemetry_;
  uint32_t dropped_ = 0;
};

}  // namespace ream::stream
