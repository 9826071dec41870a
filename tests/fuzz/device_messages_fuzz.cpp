// Messages of two clients to one device, and what the haptic thread and the clients get of them.
#include <cmath>
#include <span>
#include <vector>

#include "device/network/device_socket.hpp"
#include "device/network/remote_link.hpp"
#include "fuzz_input.hpp"

namespace ream::fuzz {
namespace {

int64_t now_ns = 0;

void require_sane(const device::RemoteInput& input) {
  double length = 0.0;
  for (const double part : input.rotation_wxyz) length += part * part;
  require(std::abs(length - 1.0) < 1e-6, "a rotation is none");
  for (const auto& numbers : {input.place_mm, input.hand_force_n, input.sideways_mm, input.lean})
    for (const double number : numbers) require(std::isfinite(number), "a number is none");
  require(std::isfinite(input.push_n), "a push is no number");
}

/// Takes all that the server has to say.
void hear(net::WebSocketSession& client) {
  for (int i = 0; i < 10 && client.next(); ++i) {
  }
  if (const auto close_reason = client.close_reason())
    require(close_reason->code >= 4000, "a close without a code");
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const auto kind = input.byte() % 2 == 0 ? device::RemoteKind::handle : device::RemoteKind::steering;
  const auto link = std::make_shared<device::RemoteLink>();
  const auto port = std::make_shared<device::DevicePort>(
      link, kind, device::DeviceWelcome{"fuzz", "network", 12.0, {}}, [] { return fuzz::now_ns; });
  port->set_state(SessionState::running);
  device::RemoteEnd end(link, [] { return fuzz::now_ns; });
  end.open();
  const std::unique_ptr<net::WebSocketSession> clients[] = {port->connect(), port->connect()};
  for (const auto& client : clients) client->on_open([] {});
  while (!input.empty()) {
    net::WebSocketSession& client = *clients[input.byte() % 2];
    fuzz::now_ns += 1'000'000;
    const std::string_view piece = input.piece();
    const std::vector<char> aligned(piece.begin(), piece.end());
    client.on_message(std::as_bytes(std::span(aligned)));
    device::RemoteInput newest;
    if (end.take(newest)) fuzz::require_sane(newest);
    end.write({});
    fuzz::hear(client);
  }
  for (const auto& client : clients) client->on_close();
  return 0;
}
