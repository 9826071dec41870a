#pragma once
#include <map>
#include <mutex>

#include "stream/fanout.hpp"

namespace ream::stream {

/// Fanout to viewers of this process.
class LocalFanout final : public Fanout {
 public:
  void publish_hello(Message hello) override;
  void publish_tool(Message hello, Message change) override;
  void publish_block(SharedBlock block) override;
  void publish_picture_complete(int stride) override;
  void publish_telemetry(SharedTelemetry batch) override;
  bool wants(int stride) const override;
  std::shared_ptr<Mailbox> subscribe(std::function<void()> notify, int stride) override;

  size_t viewers() const override;

 private:
  struct Picture {
    std::map<uint32_t, SharedBlock> blocks;  ///< newest surface of every block that holds any
    bool complete = false;
  };
  struct Viewer {
    int stride;
    std::weak_ptr<Mailbox> mailbox;
  };

  /// To the viewers of one stride, or of all (0).
  template <typename Put>
  void put_to_all(int stride, Put put);

  mutable std::mutex mutex_;
  Message hello_;
  std::map<int, Picture> pictures_;  ///< by stride
  std::vector<Viewer> viewers_;
};

}  // namespace ream::stream
