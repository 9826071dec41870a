#include "net/lingering_close.hpp"

#include <array>
#include <boost/asio/buffer.hpp>

namespace ream::net {
namespace {

using boost::system::error_code;

struct Draining : std::enable_shared_from_this<Draining> {
  Draining(Channel& of, Watchdog& by, std::shared_ptr<void> keeper)
      : channel(of), watchdog(by), owner(std::move(keeper)) {}

  /// Below TLS: what still comes is for nobody.
  void read_on() {
    channel.next_layer().async_read_some(boost::asio::buffer(discarded),
                                         [self = shared_from_this()](error_code failed, size_t) {
                                           if (failed)
                                             self->watchdog.close();
                                           else
                                             self->read_on();
                                         });
  }

  Channel& channel;
  Watchdog& watchdog;
  std::shared_ptr<void> owner;
  std::array<char, 2048> discarded;
};

}  // namespace

void close_lingering(Channel& channel, Watchdog& watchdog, std::chrono::milliseconds linger,
                     std::shared_ptr<void> owner) {
  watchdog.arm(linger, owner);
  auto draining = std::make_shared<Draining>(channel, watchdog, std::move(owner));
  channel.async_end_sending([draining](error_code) { draining->read_on(); });
}

}  // namespace ream::net
