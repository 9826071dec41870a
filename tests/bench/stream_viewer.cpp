#include "bench/stream_viewer.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "core/error.hpp"
#include "support/raw_http.hpp"

namespace ream::bench {
namespace {

constexpr int binary = 2, closed = 8;

struct Order {
  uint16_t port = 0;
  std::array<char, 64> session{};
};
struct Answer {
  bool good = false;
  uint64_t bytes = 0;
};

/// An order without a port ends the watching.
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

void answer(int out, const Answer& answer) {
  if (::write(out, &answer, sizeof answer) != sizeof answer) ::_exit(1);
}

/// One answer when greeted, one at the end.
void serve_order(const Order& order, int in, int out) {
  try {
    test::RawWebSocket stream(order.port,
                              "/api/v1/sessions/" + std::string(order.session.data()) + "/stream");
    answer(out, {stream.handshake().status == 101, 0});
    const uint64_t bytes = receive_until_told(stream, in);
    Order stop;
    if (::read(in, &stop, sizeof stop) != sizeof stop) ::_exit(0);
    answer(out, {true, bytes});
  } catch (const std::exception&) {
    answer(out, {false, 0});
  }
}

[[noreturn]] void run_child(int in, int out) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  Order order;
  while (::read(in, &order, sizeof order) == sizeof order) serve_order(order, in, out);
  ::_exit(0);
}

Answer next_answer(int from) {
  Answer answer;
  if (::read(from, &answer, sizeof answer) != sizeof answer || !answer.good)
    throw Error(ErrorKind::unavailable, "the viewer lost the session's stream");
  return answer;
}

}  // namespace

StreamViewer::StreamViewer() {
  int orders[2], answers[2];
  if (::pipe(orders) != 0 || ::pipe(answers) != 0)
    throw Error(ErrorKind::unavailable, "no pipe can be made to the viewer");
  child_ = ::fork();
  if (child_ < 0) throw Error(ErrorKind::unavailable, "no process can be started for the viewer");
  if (child_ == 0) {
    ::close(orders[1]);
    ::close(answers[0]);
    run_child(orders[0], answers[1]);
  }
  ::close(orders[0]);
  ::close(answers[1]);
  to_child_ = orders[1];
  from_child_ = answers[0];
}

StreamViewer::~StreamViewer() {
  ::close(to_child_);
  ::close(from_child_);
  ::kill(child_, SIGKILL);
  ::waitpid(child_, nullptr, 0);
}

void StreamViewer::watch(uint16_t port, const std::string& session) {
  Order order;
  order.port = port;
  std::strncpy(order.session.data(), session.c_str(), order.session.size() - 1);
  if (::write(to_child_, &order, sizeof order) != sizeof order)
    throw Error(ErrorKind::unavailable, "the viewer has ended");
  next_answer(from_child_);
}

uint64_t StreamViewer::stop_watching() {
  const Order stop;
  if (::write(to_child_, &stop, sizeof stop) != sizeof stop)
    throw Error(ErrorKind::unavailable, "the viewer has ended");
  return next_answer(from_child_).bytes;
}

}  // namespace ream::bench
