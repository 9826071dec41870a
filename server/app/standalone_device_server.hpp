#pragma once
#include <memory>
#include <string>

#include "device/network/device_socket.hpp"
#include "net/listener.hpp"
#include "net/router.hpp"

namespace ream::app {

/// Lets the client of one device connect over loopback while there is no server: it speaks the same
/// (proto/device.fbs) on the same path as with a session. Ends the connection with itself.
class StandaloneDeviceServer {
 public:
  /// `port` 0: any free one. Errors: unavailable when the port cannot be had.
  StandaloneDeviceServer(std::shared_ptr<device::RemoteLink> link, const std::string& device,
                         const device::DeviceTraits& traits, uint16_t port);

  /// Where the client connects to.
  std::string url() const;

 private:
  const std::shared_ptr<device::DevicePort> device_port_;
  net::Router router_;
  std::unique_ptr<net::Listener> listener_;
};

}  // namespace ream::app
