#pragma once
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "store/database.hpp"
#include "store/database_url.hpp"

namespace ream::store {

/// Cuts connections whose other end keeps silent: a server that hangs holds its sockets open, and the
/// client's library would wait for it forever. Thread-safe. Internal to this room.
class Deadlines {
 public:
  Deadlines();
  ~Deadlines();
  Deadlines(const Deadlines&) = delete;
  Deadlines& operator=(const Deadlines&) = delete;

  /// As long as it lives, `socket` is shut down when the time has come. The socket outlives it.
  class Watch {
   public:
    Watch(Deadlines& deadlines, int socket, SteadyClock::time_point end);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    Deadlines& deadlines_;
    std::multimap<SteadyClock::time_point, int>::iterator place_;
  };

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<SteadyClock::time_point, int> sockets_;  ///< -1: shut down already
  bool stopping_ = false;
  std::thread thread_;
};

/// A few connections, opened when they are needed. Thread-safe. Internal to this room.
class ConnectionPool {
 public:
  ConnectionPool(DatabaseUrl url, DatabaseLimits limits);
  ~ConnectionPool();

  /// A connection that somebody uses; goes back at the end, unless it was dropped.
  class Lease {
   public:
    Lease(ConnectionPool& pool, std::unique_ptr<Sql> sql, bool fresh);
    ~Lease();
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    Sql& sql() { return *sql_; }
    /// Opened just now: what fails on it is no leftover of an earlier loss.
    bool fresh() const { return fresh_; }
    void drop();

   private:
    ConnectionPool& pool_;
    std::unique_ptr<Sql> sql_;
    const bool fresh_;
  };

  /// Waits for a free one as long as the limits say. Error unavailable when there is none, or the database
  /// cannot be reached; io.
  std::unique_ptr<Lease> take();
  /// After a loss: the others are lost as well.
  void drop_idle();

  /// A transaction begins on this connection: from the limit on its server is taken to hang.
  void watch(Sql& sql, std::optional<Deadlines::Watch>& watch);

  const DatabaseUrl& url() const { return url_; }

 private:
  std::unique_ptr<Sql> open();
  void note_failure(const Error& failure, SteadyClock::time_point began);
  void give_back(std::unique_ptr<Sql> sql);

  const DatabaseUrl url_;
  const DatabaseLimits limits_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::vector<std::unique_ptr<Sql>> idle_;
  size_t in_use_ = 0;
  std::optional<Error> last_failure_;  ///< to reach it
  bool attempting_ = false;            ///< to reach it again; one at a time
  SteadyClock::time_point next_attempt_{};
  std::unique_ptr<Deadlines> deadlines_;  ///< of a server; null for a file
};

}  // namespace ream::store
