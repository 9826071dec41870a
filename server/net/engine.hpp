#pragma once
// Inside of net only: what the connections of one listener share, and how a connection of each kind begins.
#include <boost/asio/io_context.hpp>
#include <memory>
#include <string>
#include <vector>

#include "net/byte_budget.hpp"
#include "net/channel.hpp"
#include "net/client_address.hpp"
#include "net/connection_registry.hpp"
#include "net/limits.hpp"
#include "net/rate_limiter.hpp"
#include "net/router.hpp"
#include "net/tls.hpp"
#include "net/worker_pool.hpp"

namespace ream::net {

/// Destroyed bottom up: the io_context first, and with it the connections that wait on it.
struct Engine {
  Engine(const Router& routes, const Limits& peer_limits, size_t io_threads, size_t worker_threads)
      : router(routes),
        limits(peer_limits),
        address_rate(peer_limits.requests_per_address),
        bodies(peer_limits.bodies_bytes),
        workers(worker_threads, peer_limits.waiting_requests, peer_limits.waiting_of_caller, true),
        file_readers(1, 2 * peer_limits.connections),
        io(static_cast<int>(io_threads)) {}

  const Router& router;
  const Limits limits;
  std::vector<std::string> public_names;
  TrustedProxies proxies;
  std::shared_ptr<RenewedTls> tls;  ///< null: connections are plain
  RateLimiter address_rate;
  ByteBudget bodies;
  ConnectionRegistry connections;
  WorkerPool workers;
  WorkerPool file_readers;  ///< one piece at a time for every connection
  boost::asio::io_context io;
};

/// Who is connected and through which of our addresses; numeric, without ports.
struct Ends {
  std::string peer, local;
  std::string
      peer_key;  ///< what limits of connections go by: limit_key() of the peer; empty: a trusted proxy
};

Ends ends_of(const Channel::Socket& socket);

/// Serves requests on a socket whose executor is a strand of its own. `refuse`: answers 503 and ends.
void start_http(Engine& engine, Channel::Socket socket, Ends ends, bool refuse);

/// Answers the upgrade request and runs the session over the channel.
void start_websocket(Engine& engine, Channel channel, Ends ends, Request request,
                     std::unique_ptr<WebSocketSession> session);

}  // namespace ream::net
