#pragma once
#include <functional>
#include <memory>

#include "stream/mailbox.hpp"

namespace ream::stream {

/// From one session to all its viewers. Thread-safe; publishing never waits for a viewer.
class Fanout {
 public:
  virtual ~Fanout() = default;

  /// The first message of every viewer; viewers that came before it get it now, again when it changes.
  virtual void publish_hello(Message hello) = 0;
  /// Another tool is in the hand: `hello` for those who come later, `change` for those who are there.
  virtual void publish_tool(Message hello, Message change) = 0;
  /// Newest surface of its block, for the viewers of its stride; kept for late joiners unless it is empty.
  virtual void publish_block(SharedBlock block) = 0;
  /// All blocks of the first whole picture at that stride have been published.
  virtual void publish_picture_complete(int stride) = 0;
  virtual void publish_telemetry(SharedTelemetry batch) = 0;

  /// Viewers that hold a mailbox.
  virtual size_t viewers() const = 0;
  /// True when a viewer has asked for that stride.
  virtual bool wants(int stride) const = 0;

  /// A new viewer: its mailbox begins with the hello and the whole picture at the stride that it asks for, as
  /// soon as there is one. `notify` is called from publishing threads, possibly after the mailbox was let go
  /// of, so it must be quick, must not call back into the fanout and must own (or weakly hold) what it
  /// touches. Letting go of the mailbox ends the subscription.
  virtual std::shared_ptr<Mailbox> subscribe(std::function<void()> notify, int stride) = 0;
};

}  // namespace ream::stream
