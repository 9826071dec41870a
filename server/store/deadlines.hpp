#pragma once
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include "core/clock.hpp"

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

}  // namespace ream::store
