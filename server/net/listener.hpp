#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "net/limits.hpp"
#include "net/router.hpp"

namespace ream::net {

struct ListenOptions {
  std::string host = "127.0.0.1";  ///< loopback only: 127.0.0.0/8, ::1 or localhost (127.0.0.1)
  uint16_t port = 8080;            ///< 0: any free one, see Listener::port
  size_t io_threads = 1;           ///< sockets
  size_t worker_threads = 4;       ///< request handlers, which may block
  Limits limits;
};

/// HTTP/1.1 and WebSocket server over a router. Listening begins in the constructor, answering with start().
class Listener {
 public:
  /// `router` must outlive the listener and not change any more.
  /// Throws Error usage for an address that is not loopback, unavailable when the port cannot be had.
  Listener(const Router& router, const ListenOptions& options);
  /// Stops.
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// The port that is bound, also when 0 was asked for.
  uint16_t port() const;

  void start();

  /// Takes no new connections, lets requests under way finish (Limits::stop), says "going away" to WebSockets
  /// and returns when no handler and no session is called any more. Not from a handler. May be called twice.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ream::net
