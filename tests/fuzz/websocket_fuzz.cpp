// Bytes after the handshake on a true WebSocket connection, with the session of a device or of a viewer
// behind it.
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio/strand.hpp>

#include "device/network/device_socket.hpp"
#include "fuzz_input.hpp"
#include "net/engine.hpp"
#include "session/live/viewer_stream.hpp"
#include "stream/fanout.hpp"

namespace ream::fuzz {
namespace {

using boost::asio::ip::tcp;

net::Request handshake() {
  net::Request request;
  request.method = "GET";
  request.path = "/api/v1/sessions/fuzz/device";
  request.headers = {{"host", "localhost"},
                     {"upgrade", "websocket"},
                     {"connection", "Upgrade"},
                     {"sec-websocket-version", "13"},
                     {"sec-websocket-key", "dGhlIHNhbXBsZSBub25jZQ=="}};
  return request;
}

std::unique_ptr<net::WebSocketSession> session_of(uint8_t kind) {
  if (kind % 2 == 0) return session::viewer_stream(std::make_shared<stream::Fanout>(), 1);
  const auto port =
      std::make_shared<device::DevicePort>(std::make_shared<device::RemoteLink>(), device::RemoteKind::handle,
                                           device::DeviceWelcome{"fuzz", "network", 12.0, {}});
  return port->connect();
}

/// Lets the server do all it can do now, and takes what it says.
void let_run(net::Engine& engine, int client) {
  char heard[4096];
  do {
    engine.io.restart();
    engine.io.poll();
  } while (::recv(client, heard, sizeof heard, MSG_DONTWAIT) > 0);
}

void talk(net::Engine& engine, Input input) {
  int ends[2];
  require(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "no sockets");
  tcp::socket socket(boost::asio::make_strand(engine.io));
  socket.assign(tcp::v4(), ends[0]);
  const uint8_t kind = input.byte();
  net::start_websocket(engine, net::Channel(std::move(socket)), {"peer", "local", "peer"}, handshake(),
                       session_of(kind));
  let_run(engine, ends[1]);
  while (!input.empty()) {
    const std::string_view piece = input.piece();
    if (::send(ends[1], piece.data(), piece.size(), MSG_DONTWAIT | MSG_NOSIGNAL) < 0) break;
    let_run(engine, ends[1]);
  }
  ::close(ends[1]);
  // A reader and a close that wait for each other are ended by the time to linger.
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  do {
    engine.io.restart();
    engine.io.run_for(std::chrono::milliseconds(1));
  } while (engine.connections.size() > 0 && std::chrono::steady_clock::now() < until);
  require(engine.connections.size() == 0, "a connection outlives its peer");
}

/// Nobody waits long for a fuzzer's peer.
net::Limits short_limits() {
  net::Limits limits;
  limits.linger = std::chrono::milliseconds(2);
  return limits;
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  static const net::Router router;
  static net::Engine engine(router, fuzz::short_limits(), 1, 1);
  fuzz::talk(engine, fuzz::Input(data, size));
  return 0;
}
