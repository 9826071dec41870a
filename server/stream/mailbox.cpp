#include "stream/mailbox.hpp"

#include <utility>

namespace ream::stream {

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

Message Mailbox::next_telemetry() {
  const SharedTelemetry batch = std::move(telemetry_.front());
  telemetry_.pop_front();
  dropped_ += batch->lost_before;
  return telemetry_message(*batch, dropped_);
}

Message Mailbox::next_mesh() {
  std::vector<SharedBlock> blocks;
  bool complete = picture_ == Picture::sending && picture_blocks_left_ == 0;
  for (size_t bytes = 0; !order_.empty() && !complete;) {
    const auto place = newest_.find(order_.front());
    if (!blocks.empty() && bytes + place->second->bytes() > mesh_message_bytes) break;
    bytes += place->second->bytes();
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
