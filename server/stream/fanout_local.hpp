#pragma once
#include <map>
#include <mutex>

#include "stream/fanout.hpp"

namespace ream::stream {

/// Fanout to viewers of this process.
class LocalFanout final : public Fanout {
 public:
  void publish_hello(Message hello) override;
  void publish_block(SharedBlock block) override;
  void publish_picture_complete() override;
  void publish_telemetry(SharedTelemetry batch) override;
  std::shared_ptr<Mailbox> subscribe(std::function<void()> notify) override;

  /// Mailboxes still held by somebody.
  size_t viewers() const;

 private:
  template <typename Put>
  void put_to_all(Put put);

  mutable std::mutex mutex_;
  Message hello_;
  std::map<uint32_t, SharedBlock> picture_;  ///< newest surface of every block that holds any
  bool picture_complete_ = false;
  std::vector<std::weak_ptr<Mailbox>> viewers_;
};

}  // namespace ream::stream
