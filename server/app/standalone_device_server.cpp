#include "app/standalone_device_server.hpp"

namespace ream::app {
namespace {

const std::string trial_session = "trial";

}  // namespace

StandaloneDeviceServer::StandaloneDeviceServer(std::shared_ptr<device::RemoteLink> link,
                                               const std::string& device, const device::DeviceTraits& traits,
                                               uint16_t port)
    : device_port_(std::make_shared<device::DevicePort>(
          std::move(link), device::RemoteKind::handle,
          device::DeviceWelcome{trial_session, device, traits.force_max_n, traits.stale})) {
  router_.on_websocket("/api/v1/sessions/" + trial_session + "/device",
                       [door = device_port_](const net::Request&) { return door->connect(); });
  net::ListenOptions options;
  options.port = port;
  options.worker_threads = 1;
  listener_ = std::make_unique<net::Listener>(router_, options);
  device_port_->set_state(SessionState::running);
  listener_->start();
}

std::string StandaloneDeviceServer::url() const {
  return "ws://127.0.0.1:" + std::to_string(listener_->port()) + "/api/v1/sessions/" + trial_session +
         "/device";
}

}  // namespace ream::app
