#pragma once
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ream::net {

/// The client's side of a WebSocket that speaks text, for a thread of its own that may wait: every call ends
/// within its time, but for the first connect() to a host by its name, which may take as long as this system
/// looks for names (half a minute where its name servers do not answer). Plain TCP, no TLS: for services on
/// this machine or in the same room. One thread.
class WebSocketClient {
 public:
  using Milliseconds = std::chrono::milliseconds;

  WebSocketClient();
  ~WebSocketClient();
  WebSocketClient(const WebSocketClient&) = delete;
  WebSocketClient& operator=(const WebSocketClient&) = delete;

  /// Connects anew; what was open is dropped. `host`: a name or an address; where it is found is looked for
  /// once and then kept. Error unavailable, naming host, port and reason.
  void connect(const std::string& host, uint16_t port, const std::string& target, Milliseconds timeout);
  /// One message, UTF-8. Error unavailable when it did not leave; the connection is gone then.
  void send(std::string_view text, Milliseconds timeout);
  /// The next whole message, text or binary; empty: none has come yet, and asking goes on with the next call.
  /// Valid until that. Error unavailable when the connection has ended, or the message is above 1 MB.
  std::optional<std::string_view> receive(Milliseconds timeout);
  /// Says goodbye and ends the connection, within 200 ms. Safe to call twice.
  void close() noexcept;
  bool is_open() const noexcept;

 private:
  struct Parts;
  struct ResolvedHost;
  void resolve(const std::string& host, uint16_t port, Milliseconds timeout);
  void handshake(const std::string& target, Milliseconds timeout);

  std::unique_ptr<Parts> parts_;
  std::unique_ptr<ResolvedHost> resolved_;  ///< null: nothing yet
};

}  // namespace ream::net
