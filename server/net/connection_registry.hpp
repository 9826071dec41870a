#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "net/limits.hpp"

namespace ream::net {

/// A socket with a peer. It lives as long as it has something to wait for.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;
  /// What of a request it waits for; the later ones are the first to give way.
  enum class Wait : uint8_t { nothing, body, head, request };

  /// `address`: what limits go by.
  explicit Connection(std::string address) : address_(std::move(address)) {}
  virtual ~Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Asks it to end soon: at once when it waits, else after its reply. From any thread.
  virtual void shut_down() = 0;
  /// The I/O threads are gone: last chance to let go of what it holds.
  virtual void abandon() noexcept = 0;

  const std::string& address() const { return address_; }
  Wait wait() const { return wait_; }
  Clock::time_point waits_since() const { return Clock::time_point(Clock::duration(since_.load())); }

 protected:
  void set_wait(Wait wait) {
    since_ = Clock::now().time_since_epoch().count();
    wait_ = wait;
  }

 private:
  const std::string address_;
  std::atomic<Wait> wait_{Wait::nothing};
  std::atomic<Clock::rep> since_{0};
};

/// Who is connected, and who finds a place. Thread-safe.
class ConnectionRegistry {
 public:
  enum class Place {
    free,
    busy,      ///< nobody can give way: the newcomer is to be told so
    overfull,  ///< too many are being told so already
  };

  /// Whether one more of `address` (empty: that of a proxy, which stands for many) may come. Where all places
  /// are taken, of the server or of that address, the connection that has waited longest for its peer is shut
  /// down for it.
  Place make_room(const std::string& address, const Limits& limits);

  /// False once closed: the connection must not begin. `leaving`: it takes no place, as it is about to end.
  bool add(const std::shared_ptr<Connection>& connection, bool leaving = false);
  void remove(Connection* connection);
  size_t size() const;
  std::vector<std::shared_ptr<Connection>> all() const;
  /// No more connections are added from now on.
  void close();
  /// Waits until nobody is connected any more; false when that took longer.
  bool wait_until_empty(std::chrono::milliseconds timeout);

 private:
  struct Entry {
    std::weak_ptr<Connection> connection;
    bool leaving = false;
  };
  /// With the mutex held: who gives way; of one address, or of all when it is empty.
  std::shared_ptr<Connection> longest_waiting(const std::string& address);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::unordered_map<Connection*, Entry> connections_;
  bool closed_ = false;
};

}  // namespace ream::net
