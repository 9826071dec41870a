#include "stream/fanout.hpp"

#include <algorithm>

namespace ream::stream {

// The lock is held while putting: a viewer that joins meanwhile gets each block exactly from the picture or
// as news.
template <typename Put>
void Fanout::put_to_all(int stride, Put put) {
  std::erase_if(viewers_, [&](const Viewer& viewer) {
    const std::shared_ptr<Mailbox> mailbox = viewer.mailbox.lock();
    if (mailbox && (stride == 0 || stride == viewer.stride)) put(*mailbox);
    return !mailbox;
  });
}

void Fanout::publish_hello(Message hello) {
  const std::lock_guard lock(mutex_);
  hello_ = std::move(hello);
  put_to_all(0, [&](Mailbox& mailbox) { mailbox.put_hello(hello_); });
}

void Fanout::publish_tool(Message hello, Message change) {
  const std::lock_guard lock(mutex_);
  hello_ = std::move(hello);
  put_to_all(0, [&](Mailbox& mailbox) { mailbox.put_tool(change); });
}

void Fanout::publish_block(SharedBlock block) {
  const std::lock_guard lock(mutex_);
  auto& blocks = pictures_[block->stride].blocks;
  if (block->empty())
    blocks.erase(block->block);
  else
    blocks[block->block] = block;
  put_to_all(block->stride, [&](Mailbox& mailbox) { mailbox.put_block(block); });
}

void Fanout::publish_picture_complete(int stride) {
  const std::lock_guard lock(mutex_);
  pictures_[stride].complete = true;
  put_to_all(stride, [](Mailbox& mailbox) { mailbox.put_picture_complete(); });
}

void Fanout::publish_telemetry(SharedTelemetry batch) {
  const std::lock_guard lock(mutex_);
  put_to_all(0, [&](Mailbox& mailbox) { mailbox.put_telemetry(batch); });
}

bool Fanout::wants(int stride) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(viewers_.begin(), viewers_.end(), [stride](const Viewer& viewer) {
    return viewer.stride == stride && !viewer.mailbox.expired();
  });
}

std::shared_ptr<Mailbox> Fanout::subscribe(std::function<void()> notify, int stride) {
  const std::lock_guard lock(mutex_);
  auto mailbox = std::make_shared<Mailbox>(std::move(notify));
  if (hello_) mailbox->put_hello(hello_);
  const Picture& picture = pictures_[stride];
  for (const auto& [key, block] : picture.blocks) mailbox->put_block(block);
  if (picture.complete) mailbox->put_picture_complete();
  viewers_.push_back({stride, mailbox});
  return mailbox;
}

size_t Fanout::viewers() const {
  const std::lock_guard lock(mutex_);
  return static_cast<size_t>(
      std::count_if(viewers_.begin(), viewers_.end(), [](const Viewer& v) { return !v.mailbox.expired(); }));
}

}  // namespace ream::stream
