#include "stream/mailbox.hpp"

#include <utility>

namespace ream::stream {

namespace {

/// What a block takes in a message beside its streams, about.
constexpr size_t table_bytes = 96;

/// Whether the two are one batch that was taken in two.
bool continues(const TelemetryBatch& first, const TelemetryBatch& second) {
  const TelemetrySample &last = first.samples.back(), &next = second.samples.front();
  const auto jump = [](const TelemetrySample& sample) {
    return sample.playback ? std::optional(sample.playback->jump) : std::nullopt;
  };
  return second.lost_before == 0 && second.tick_stride == first.tick_stride &&
         next.tick == last.tick + first.tick_stride && jump(next) == jump(last);
}

}  // namespace

Message Mailbox::next() {
  const std::lock_guard lock(mutex_);
  if (hello_) return std::exchange(hello_, nullptr);
  if (tool_) return std::exchange(tool_, nullptr);
  const bool mesh_waits = !order_.empty() || picture_ == Picture::sending;
  if (!telemetry_.empty() && !(mesh_waits && telemetry_had_its_turn_)) {
    telemetry_had_its_turn_ = true;
    return next_telemetry();
  }
  telemetry_had_its_turn_ = false;
  if (mesh_waits) return next_mesh();
  asleep_ = true;
  return nullptr;
}

Parcel Mailbox::take() {
  const std::lock_guard lock(mutex_);
  Parcel parcel;
  for (const uint32_t key : order_) parcel.blocks.push_back(std::move(newest_.at(key)));
  order_.clear();
  newest_.clear();
  if (!telemetry_.empty()) parcel.newest = std::move(telemetry_.back());
  telemetry_.clear();
  hello_ = tool_ = nullptr;
  if (picture_ == Picture::sending) picture_ = Picture::sent;
  parcel.picture_complete = picture_ == Picture::sent;
  asleep_ = true;
  return parcel;
}

Message Mailbox::next_telemetry() {
  SharedTelemetry batch = std::move(telemetry_.front());
  telemetry_.pop_front();
  dropped_ += batch->lost_before;
  if (telemetry_.empty() || !continues(*batch, *telemetry_.front()))
    return telemetry_message(*batch, dropped_);
  TelemetryBatch joined = *batch;
  while (!telemetry_.empty() && continues(joined, *telemetry_.front())) {
    const TelemetryBatch& more = *telemetry_.front();
    joined.samples.insert(joined.samples.end(), more.samples.begin(), more.samples.end());
    joined.stamp_us = more.stamp_us;
    telemetry_.pop_front();
  }
  return telemetry_message(joined, dropped_);
}

Message Mailbox::next_mesh() {
  std::vector<SharedBlock> blocks;
  bool complete = picture_ == Picture::sending && picture_blocks_left_ == 0;
  const size_t max_bytes = picture_ == Picture::sent ? update_message_bytes : mesh_message_bytes;
  for (size_t bytes = 0; !order_.empty() && !complete;) {
    const auto place = newest_.find(order_.front());
    const size_t block_bytes = place->second->bytes() + table_bytes;
    if (!blocks.empty() && bytes + block_bytes > max_bytes) break;
    bytes += block_bytes;
    blocks.push_back(std::move(place->second));
    newest_.erase(place);
    order_.pop_front();
    if (picture_ == Picture::sending) complete = --picture_blocks_left_ == 0;
  }
  if (complete) picture_ = Picture::sent;
  return mesh_message(blocks, complete);
}

void Mailbox::put_hello(Message hello) {
  std::unique_lock lock(mutex_);
  hello_ = std::move(hello);
  wake(std::move(lock));
}

void Mailbox::put_tool(Message change) {
  std::unique_lock lock(mutex_);
  tool_ = std::move(change);
  wake(std::move(lock));
}

void Mailbox::put_block(SharedBlock block) {
  std::unique_lock lock(mutex_);
  const uint32_t key = block->block;
  if (newest_.insert_or_assign(key, std::move(block)).second) order_.push_back(key);
  wake(std::move(lock));
}

void Mailbox::put_telemetry(SharedTelemetry batch) {
  std::unique_lock lock(mutex_);
  telemetry_.push_back(std::move(batch));
  if (telemetry_.size() > max_telemetry_batches) {
    const TelemetryBatch& oldest = *telemetry_.front();
    dropped_ += oldest.lost_before + static_cast<uint32_t>(oldest.samples.size());
    telemetry_.pop_front();
  }
  wake(std::move(lock));
}

void Mailbox::put_picture_complete() {
  std::unique_lock lock(mutex_);
  if (picture_ != Picture::incomplete) return;
  picture_ = Picture::sending;
  picture_blocks_left_ = order_.size();
  wake(std::move(lock));
}

void Mailbox::wake(std::unique_lock<std::mutex> lock) {
  const bool owed = std::exchange(asleep_, false);
  lock.unlock();
  if (owed && notify_) notify_();
}

}  // namespace ream::stream
