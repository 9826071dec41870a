#pragma once
#include <chrono>
#include <cstddef>

#include "net/rate_limiter.hpp"

namespace ream::net {

/// What one peer may cost the server.
struct Limits {
  // Sizes.
  size_t header_bytes = 16 * 1024;      ///< of a request, all lines together
  size_t header_lines = 100;            ///< without the request line
  size_t header_line_bytes = 8 * 1024;  ///< one of them
  size_t target_bytes = 4 * 1024;       ///< the request line
  size_t body_bytes = 1024 * 1024;
  size_t bodies_bytes = 64 * 1024 * 1024;      ///< of all requests under way; more are answered 503
  size_t file_piece_bytes = 128 * 1024;        ///< held in memory of a file that is sent
  size_t websocket_message_bytes = 64 * 1024;  ///< received

  // Numbers. A full house lets the oldest connection go that only waits for a request, so that somebody new
  // finds a place at once; only where all are busy is the newcomer answered 503.
  size_t connections = 512;
  size_t connections_per_address = 256;  ///< IPv6: of one /64
  size_t waiting_requests = 128;         ///< of one urgency, not yet taken by a worker; more are answered 503
  size_t waiting_of_caller = 64;         ///< among them; more are answered 429
  size_t small_body_bytes = 4 * 1024;    ///< are always held, whatever bodies_bytes says

  // Rates; what is beyond is answered 429 with Retry-After, before any handler runs.
  Rate requests_per_address{1000.0, 2000.0};
  Rate requests_per_caller{500.0, 1000.0};   ///< of one user or token; see Router::pace_callers
  double handshake_cost = 10.0;              ///< of a TLS handshake, in requests of its address
  Rate websocket_messages{8000.0, 16000.0};  ///< of one connection; a frame counts 1, and 1 more per KiB

  // Times.
  std::chrono::milliseconds idle{30'000};   ///< between requests; a WebSocket is pinged after half of it
  std::chrono::milliseconds header{5'000};  ///< for a TLS handshake, and for a header once it has begun
  std::chrono::milliseconds body{10'000};   ///< for a body without progress
  std::chrono::milliseconds write{10'000};  ///< for a write without progress
  size_t min_bytes_per_s = 8 * 1024;  ///< of bodies and replies on average, once `body` or `write` is over
  std::chrono::milliseconds linger{2'000};  ///< for a peer to take our last words before the socket closes
  std::chrono::milliseconds stop{3'000};    ///< for requests under way when the server stops
};

}  // namespace ream::net
