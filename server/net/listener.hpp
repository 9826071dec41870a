#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/client_address.hpp"
#include "net/limits.hpp"
#include "net/router.hpp"
#include "net/tls.hpp"

namespace ream::net {

struct ListenOptions {
  std::string host =
      "127.0.0.1";       ///< an address of this machine, 0.0.0.0 or :: for all, or localhost (127.0.0.1)
  uint16_t port = 8080;  ///< 0: any free one, see Listener::port
  /// Other addresses than loopback may be bound. Whether that is safe (users, TLS) is for the caller to know.
  bool beyond_loopback = false;
  /// Names and addresses by which people reach this server from elsewhere, besides the address it listens on;
  /// without scheme and port. Requests for any other host are refused.
  std::vector<std::string> public_names;
  /// Peers that say for whom they ask. They may open connections as many as there are places.
  std::vector<TrustedProxy> trusted_proxies;
  std::optional<TlsOptions> tls;  ///< with it the port speaks HTTPS only
  std::chrono::milliseconds look_at_certificate_every = std::chrono::minutes(1);
  size_t io_threads = 1;      ///< sockets
  size_t worker_threads = 4;  ///< request handlers, which may block; more are kept for urgent ones
  Limits limits;
};

/// HTTP/1.1 and WebSocket server over a router, plain or with TLS. Listening begins in the constructor,
/// answering with start().
class Listener {
 public:
  /// `router` must outlive the listener and not change any more.
  /// Throws Error usage for an address that may not be bound or a name that is none, unavailable when the
  /// port cannot be had; for certificate and key see TlsContext.
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
