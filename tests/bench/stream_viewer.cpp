#include "bench/stream_viewer.hpp"

#include <poll.h>
#include <unistd.h>

#include <map>
#include <stdexcept>

#include "core/error.hpp"
#include "support/raw_http.hpp"

namespace ream::bench {
namespace {

constexpr int binary = 2, closed = 8;

struct ViewerAnswer {
  bool good = false;
  uint64_t bytes = 0;
};

/// A door without a port ends the watching.
bool has_order(int in) {
  pollfd waiting{in, POLLIN, 0};
  return ::poll(&waiting, 1, 0) > 0;
}

/// Until it is told to stop; a resting session says so twice a second, so that nobody waits long.
uint64_t receive_until_told(test::RawWebSocket& stream, int in) {
  uint64_t bytes = 0;
  while (!has_order(in)) {
    const auto message = stream.receive();
    if (message.opcode == closed) break;
    if (message.opcode == binary) bytes += message.payload.size();
  }
  return bytes;
}

void answer(int out, const ViewerAnswer& answer) {
  if (::write(out, &answer, sizeof answer) != sizeof answer) ::_exit(1);
}

/// One answer when greeted, one at the end.
void serve_order(const Door& door, int in, int out) {
  try {
    std::map<std::string, std::string> headers;
    if (door.needs_token()) headers["Authorization"] = door.authorization();
    test::RawWebSocket stream(door.port, door.session_path() + "/stream", headers);
    answer(out, {stream.handshake().status == 101, 0});
    const uint64_t bytes = receive_until_told(stream, in);
    Door stop;
    if (::read(in, &stop, sizeof stop) != sizeof stop) ::_exit(0);
    answer(out, {true, bytes});
  } catch (const std::exception&) {
    answer(out, {false, 0});
  }
}

void serve_viewer_orders(int in, int out) {
  Door door;
  while (::read(in, &door, sizeof door) == sizeof door) serve_order(door, in, out);
}

ViewerAnswer good_answer(const SideProcess& process) {
  const ViewerAnswer answer = process.receive<ViewerAnswer>();
  if (!answer.good) throw Error(ErrorKind::unavailable, "the viewer lost the session's stream");
  return answer;
}

}  // namespace

StreamViewer::StreamViewer() : process_(serve_viewer_orders) {}

void StreamViewer::watch(const Door& door) {
  process_.send(door);
  good_answer(process_);
}

uint64_t StreamViewer::stop_watching() {
  process_.send(Door{});
  return good_answer(process_).bytes;
}

}  // namespace ream::bench
