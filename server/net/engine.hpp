#pragma once
// Inside of net only: what the connections of one listener share.
#include <boost/asio/io_context.hpp>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "net/limits.hpp"
#include "net/router.hpp"
#include "net/worker_pool.hpp"

namespace ream::net {

/// A socket with a peer. It lives as long as it has something to wait for.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Asks it to end soon; from any thread.
  virtual void shut_down() = 0;
  /// The I/O threads are gone: last chance to let go of what it holds.
  virtual void abandon() noexcept = 0;
};

/// Who is connected. Thread-safe.
class ConnectionRegistry {
 public:
  /// False once closed: the connection must not begin.
  bool add(const std::shared_ptr<Connection>& connection);
  void remove(Connection* connection);
  size_t size() const;
  std::vector<std::shared_ptr<Connection>> all() const;
  /// No more connections are added from now on.
  void close();
  /// Waits until nobody is connected any more; false when that took longer.
  bool wait_until_empty(std::chrono::milliseconds longest);

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::unordered_map<Connection*, std::weak_ptr<Connection>> connections_;
  bool closed_ = false;
};

/// Destroyed bottom up: the io_context first, and with it the connections that wait on it.
struct Engine {
  Engine(const Router& routes, const Limits& most, size_t io_threads, size_t worker_threads)
      : router(routes),
        limits(most),
        workers(worker_threads, most.waiting_requests),
        file_readers(1, most.connections),
        io(static_cast<int>(io_threads)) {}

  const Router& router;
  const Limits limits;
  ConnectionRegistry connections;
  WorkerPool workers;
  WorkerPool file_readers;  ///< one piece at a time for every connection
  boost::asio::io_context io;
};

}  // namespace ream::net
