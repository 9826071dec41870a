#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "net/message.hpp"

namespace ream::net {

/// How a session ends a connection from its side.
struct CloseReason {
  uint16_t code = 1000;  ///< RFC 6455, 7.4; 4000 to 4999 are the session's own
  std::string text;      ///< for people; what goes beyond 123 bytes is cut off
};

/// The server's side of one WebSocket connection. All calls come one after another (never two at once) from
/// the I/O threads, so none may block. An exception that leaves a call closes the connection (code 1011).
class WebSocketSession {
 public:
  virtual ~WebSocketSession() = default;

  /// First call, once the connection is open. `wake` asks the server to call next() again; it may be called
  /// from any thread, any number of times, also after the connection is gone.
  virtual void on_open(std::function<void()> wake) = 0;

  /// Whether what it sends is text (UTF-8, JSON say), binary otherwise. Always the same answer. What comes in
  /// may be either.
  virtual bool sends_text() const { return false; }

  /// The next message, or nothing for now. Asked for when the previous one has left and after each wake, so a
  /// slow viewer pulls less often and the session decides what it may skip.
  virtual std::optional<SharedBytes> next() = 0;

  /// Asked for whenever next() has nothing: a reason closes the connection.
  virtual std::optional<CloseReason> close_reason() { return std::nullopt; }

  /// One whole message of the peer, aligned as new memory is.
  virtual void on_message(std::span<const std::byte> message) = 0;

  /// Last call, whoever ended the connection.
  virtual void on_close() noexcept = 0;
};

}  // namespace ream::net
