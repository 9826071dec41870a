#pragma once
#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "stream/mailbox.hpp"

namespace ream::stream {

/// From one session to all its viewers in this process. Thread-safe; publishing never waits for a viewer.
class Fanout {
 public:
  /// The first message of every viewer; viewers that came before it get it now, again when it changes.
  void publish_hello(Message hello);
  /// Another tool is in the hand: `hello` for those who come later, `change` for those who are there.
  void publish_tool(Message hello, Message change);
  /// Newest surface of its block, for the viewers of its stride; kept for late joiners unless it is empty.
  void publish_block(SharedBlock block);
  /// All blocks of the first whole picture at that stride have been published.
  void publish_picture_complete(int stride);
  void publish_telemetry(SharedTelemetry batch);

  /// Viewers that hold a mailbox.
  size_t viewers() const;
  /// True when a viewer has asked for that stride.
  bool wants(int stride) const;

  /// A new viewer: its mailbox begins with the hello and the whole picture at the stride that it asks for, as
  /// soon as there is one. `notify` is called from publishing threads, possibly after the mailbox was let go
  /// of, so it must be quick, must not call back into the fanout and must own (or weakly hold) what it
  /// touches. Letting go of the mailbox ends the subscription.
  std::shared_ptr<Mailbox> subscribe(std::function<void()> notify, int stride);

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
