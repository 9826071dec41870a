#include "net/watchdog.hpp"

#include <boost/asio/buffer.hpp>

namespace ream::net {
using boost::system::error_code;

void Watchdog::arm(std::chrono::milliseconds time, std::shared_ptr<void> owner) {
  timer_.expires_after(time);
  timer_.async_wait([this, owner = std::move(owner), due = timer_.expiry()](error_code) {
    // A cancelled wait can already be on its way: only the deadline itself decides.
    if (armed_ && timer_.expiry() == due && due <= std::chrono::steady_clock::now()) close();
  });
  armed_ = true;
}

void Watchdog::disarm() {
  armed_ = false;
  timer_.cancel();
}

void Watchdog::close() {
  disarm();
  channel_.close();
}

void Watchdog::close_lingering(std::chrono::milliseconds linger, std::shared_ptr<void> owner) {
  arm(linger, owner);
  discarded_.resize(2048);
  channel_.async_end_sending(
      [this, owner = std::move(owner)](error_code) mutable { drain_input(std::move(owner)); });
}

void Watchdog::drain_input(std::shared_ptr<void> owner) {
  channel_.async_discard(boost::asio::buffer(discarded_),
                         [this, owner = std::move(owner)](error_code failed, size_t) {
                           if (failed)
                             close();
                           else
                             drain_input(owner);
                         });
}

}  // namespace ream::net
