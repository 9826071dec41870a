#pragma once
// Inside of net only: what the connections of one listener share.
#include <boost/asio/io_context.hpp>
#include <memory>
#include <string>
#include <vector>

#include "net/byte_budget.hpp"
#include "net/connection_registry.hpp"
#include "net/limits.hpp"
#include "net/rate_limiter.hpp"
#include "net/router.hpp"
#include "net/tls.hpp"
#include "net/worker_pool.hpp"

namespace ream::net {

/// Destroyed bottom up: the io_context first, and with it the connections that wait on it.
struct Engine {
  Engine(const Router& routes, const Limits& most, size_t io_threads, size_t worker_threads)
      : router(routes),
        limits(most),
        address_rate(most.requests_per_address),
        bodies(most.bodies_bytes),
        workers(worker_threads, most.waiting_requests),
        file_readers(1, 2 * most.connections),
        io(static_cast<int>(io_threads)) {}

  const Router& router;
  const Limits limits;
  std::vector<std::string> public_names;
  std::shared_ptr<TlsContext> tls;  ///< null: connections are plain
  RateLimiter address_rate;
  ByteBudget bodies;
  ConnectionRegistry connections;
  WorkerPool workers;
  WorkerPool file_readers;  ///< one piece at a time for every connection
  boost::asio::io_context io;
};

}  // namespace ream::net
