#include "stream/fanout_local.hpp"

#include <algorithm>

namespace ream::stream {

// The lock is held while putting: a viewer that joins meanwhile gets each block exactly from the picture or
// as news.
template <typename Put>
void LocalFanout::put_to_all(Put put) {
  std::erase_if(viewers_, [&](const std::weak_ptr<Mailbox>& viewer) {
    const std::shared_ptr<Mailbox> mailbox = viewer.lock();
    if (mailbox) put(*mailbox);
    return !mailbox;
  });
}

void LocalFanout::publish_hello(Message hello) {
  const std::lock_guard lock(mutex_);
  hello_ = std::move(hello);
  put_to_all([&](Mailbox& mailbox) { mailbox.put_hello(hello_); });
}

void LocalFanout::publish_block(SharedBlock block) {
  const std::lock_guard lock(mutex_);
  if (block->empty())
    picture_.erase(block->block);
  else
    picture_[block->block] = block;
  put_to_all([&](Mailbox& mailbox) { mailbox.put_block(block); });
}

void LocalFanout::publish_picture_complete() {
  const std::lock_guard lock(mutex_);
  picture_complete_ = true;
  put_to_all([](Mailbox& mailbox) { mailbox.put_picture_complete(); });
}

void LocalFanout::publish_telemetry(SharedTelemetry batch) {
  const std::lock_guard lock(mutex_);
  put_to_all([&](Mailbox& mailbox) { mailbox.put_telemetry(batch); });
}

std::shared_ptr<Mailbox> LocalFanout::subscribe(std::function<void()> notify) {
  const std::lock_guard lock(mutex_);
  auto mailbox = std::make_shared<Mailbox>(std::move(notify));
  if (hello_) mailbox->put_hello(hello_);
  for (const auto& [key, block] : picture_) mailbox->put_block(block);
  if (picture_complete_) mailbox->put_picture_complete();
  viewers_.push_back(mailbox);
  return mailbox;
}

size_t LocalFanout::viewers() const {
  const std::lock_guard lock(mutex_);
  return static_cast<size_t>(
      std::count_if(viewers_.begin(), viewers_.end(), [](const auto& v) { return !v.expired(); }));
}

}  // namespace ream::stream
