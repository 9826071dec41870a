#pragma once
// Inside of net only.
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <memory>
#include <vector>

#include "net/channel.hpp"

namespace ream::net {

/// Closes a channel when its time is up. Belongs to one connection and runs on its strand, so a close never
/// races with another use of the socket; everything pending on it then ends with operation_aborted.
class Watchdog {
 public:
  explicit Watchdog(Channel& channel) : channel_(channel), timer_(channel.get_executor()) {}

  /// (Re)starts the time. `owner` keeps the channel alive meanwhile.
  void arm(std::chrono::milliseconds time, std::shared_ptr<void> owner);
  void disarm();
  /// Closes now; there is nothing left to watch.
  void close();

  /// Closes so that the peer gets our last words: tells it that nothing more comes and reads on until it
  /// closes too, for `linger` at most. Closing a socket with unread input would reset it, and what the peer
  /// has not read by then may be lost. `owner` keeps the channel and this alive; nothing else may be reading.
  void close_lingering(std::chrono::milliseconds linger, std::shared_ptr<void> owner);

 private:
  void drain_input(std::shared_ptr<void> owner);

  Channel& channel_;
  boost::asio::steady_timer timer_;
  std::vector<char> discarded_;
  bool armed_ = false;
};

}  // namespace ream::net
