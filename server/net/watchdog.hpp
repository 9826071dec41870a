#pragma once
// Inside of net only.
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <memory>

#include "net/channel.hpp"

namespace ream::net {

/// Closes a channel when its time is up. Belongs to one connection and runs on its strand, so a close never
/// races with another use of the socket; everything pending on it then ends with operation_aborted.
class Watchdog {
 public:
  explicit Watchdog(Channel& channel) : channel_(channel), timer_(channel.get_executor()) {}

  /// (Re)starts the time. `owner` keeps the channel alive meanwhile.
  void arm(std::chrono::milliseconds time, std::shared_ptr<void> owner) {
    timer_.expires_after(time);
    timer_.async_wait([this, owner = std::move(owner), due = timer_.expiry()](boost::system::error_code) {
      // A cancelled wait can already be on its way: only the deadline itself decides.
      if (armed_ && timer_.expiry() == due && due <= std::chrono::steady_clock::now()) close();
    });
    armed_ = true;
  }

  void disarm() {
    armed_ = false;
    timer_.cancel();
  }

  /// Closes now; there is nothing left to watch.
  void close() {
    disarm();
    channel_.close();
  }

 private:
  Channel& channel_;
  boost::asio::steady_timer timer_;
  bool armed_ = false;
};

}  // namespace ream::net
