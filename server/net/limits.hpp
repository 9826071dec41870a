#pragma once
#include <chrono>
#include <cstddef>

namespace ream::net {

/// What one peer may cost the server.
struct Limits {
  size_t header_bytes = 16 * 1024;
  size_t body_bytes = 1024 * 1024;
  size_t websocket_message_bytes = 64 * 1024;  ///< received
  size_t file_piece_bytes = 128 * 1024;        ///< held in memory of a file that is sent
  size_t connections = 256;                    ///< more are answered 503
  size_t waiting_requests = 128;               ///< not yet taken by a worker; more are answered 503
  std::chrono::milliseconds idle{30'000};      ///< between requests, and for one request to arrive whole
  std::chrono::milliseconds write{10'000};     ///< without progress of a write, then the connection is cut
  std::chrono::milliseconds linger{2'000};     ///< for a peer to take our last words before the socket closes
  std::chrono::milliseconds stop{3'000};       ///< for requests under way when the server stops
};

}  // namespace ream::net
