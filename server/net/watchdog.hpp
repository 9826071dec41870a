#pragma once
// Inside of net only.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <memory>

namespace ream::net {

/// Closes a socket when its time is up. Belongs to one connection and runs on its strand, so a close never
/// races with another use of the socket; everything pending on it then ends with operation_aborted.
class Watchdog {
 public:
  explicit Watchdog(boost::asio::ip::tcp::socket& socket) : socket_(socket), timer_(socket.get_executor()) {}

  /// (Re)starts the time. `owner` keeps the socket alive meanwhile.
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

  void close() {
    boost::system::error_code ignored;
    socket_.close(ignored);
  }

 private:
  boost::asio::ip::tcp::socket& socket_;
  boost::asio::steady_timer timer_;
  bool armed_ = false;
};

}  // namespace ream::net
