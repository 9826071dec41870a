#include "bench/hostile_crowd.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/clock.hpp"
#include "support/raw_http.hpp"

namespace ream::bench {
namespace {

using namespace std::chrono_literals;

constexpr size_t crowd = 1000;
constexpr size_t body_bytes = 100'000'000;
constexpr auto between_attacks = 5ms, between_drops = 200ms;

struct Order {
  Door door;
  double duration_s = 0.0;
};

class Siege {
 public:
  explicit Siege(const Order& order)
      : order_(order),
        end_(SteadyClock::now() + std::chrono::duration_cast<SteadyClock::duration>(
                                      std::chrono::duration<double>(order.duration_s))) {}

  HostileFigures lay() {
    std::vector<std::thread> threads;
    threads.emplace_back([this] { wait_and_drip(); });
    threads.emplace_back([this] { again_and_again([this] { send_large_body(); }); });
    threads.emplace_back([this] { again_and_again([this] { send_endless_header(); }); });
    threads.emplace_back([this] { again_and_again([this] { send_nonsense("/stream"); }); });
    threads.emplace_back([this] { again_and_again([this] { send_nonsense("/device"); }); });
    for (std::thread& thread : threads) thread.join();
    return {connections_, held_, attacks_, static_cast<double>(sent_bytes_) * 1e-6};
  }

 private:
  bool is_over() const { return SteadyClock::now() >= end_; }

  std::unique_ptr<test::RawSocket> connect() {
    ++connections_;
    return std::make_unique<test::RawSocket>(order_.door.port);
  }

  bool say(test::RawSocket& socket, const std::string& bytes) {
    const bool went = socket.try_send(bytes);
    if (went) sent_bytes_ += bytes.size();
    return went;
  }

  /// Every second of the crowd never says a word; those that are sent away come again.
  void wait_and_drip() {
    std::vector<std::unique_ptr<test::RawSocket>> all(crowd);
    while (!is_over()) {
      uint64_t held = 0;
      for (size_t i = 0; i < crowd && !is_over(); ++i) try {
          if (!all[i]) {
            all[i] = connect();
            if (i % 2 == 0) say(*all[i], "GET / HTTP/1.1\r\nHost: localhost\r\nX-Slow: ");
          } else if (i % 2 == 0 && !say(*all[i], "x")) {
            all[i].reset();
          }
          held += all[i] ? 1 : 0;
        } catch (const std::runtime_error&) {
          all[i].reset();
        }
      held_ = std::max(held_.load(), held);
      std::this_thread::sleep_for(between_drops);
    }
  }

  void again_and_again(const std::function<void()>& attack) {
    while (!is_over()) {
      try {
        ++attacks_;
        attack();
      } catch (const std::runtime_error&) {
      }
      std::this_thread::sleep_for(between_attacks);
    }
  }

  void send_large_body() {
    const auto socket = connect();
    say(*socket,
        "POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Type: "
        "application/json\r\nAuthorization: " +
            order_.door.authorization() + "\r\nTransfer-Encoding: chunked\r\n\r\n");
    const std::string chunk = "10000\r\n" + std::string(0x10000, ' ') + "\r\n";
    for (size_t sent = 0; sent < body_bytes && !is_over() && say(*socket, chunk); sent += 0x10000) {
    }
  }

  void send_endless_header() {
    const auto socket = connect();
    say(*socket, "GET / HTTP/1.1\r\nHost: localhost\r\n");
    while (!is_over() && say(*socket, "X-More: " + std::string(1000, 'x') + "\r\n")) {
    }
  }

  /// Frames of random bytes, until the server has had enough.
  void send_nonsense(const char* stream) {
    ++connections_;
    test::RawWebSocket socket(order_.door.port, order_.door.session_path() + stream,
                              {{"Authorization", order_.door.authorization()}});
    if (socket.handshake().status != 101) return;
    thread_local std::mt19937 random(1);
    for (int i = 0; i < 100 && !is_over(); ++i) {
      std::string bytes(random() % 2000, '\0');
      for (char& byte : bytes) byte = static_cast<char>(random());
      if (i % 4 == 3) {
        if (!say(socket.socket(), bytes)) return;
      } else {
        socket.send_binary(bytes);
        sent_bytes_ += bytes.size();
      }
    }
  }

  const Order& order_;
  const SteadyClock::time_point end_;
  std::atomic<uint64_t> connections_{0}, held_{0}, attacks_{0}, sent_bytes_{0};
};

void serve_orders(int in, int out) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
  Order order;
  while (::read(in, &order, sizeof order) == sizeof order) {
    const HostileFigures figures = Siege(order).lay();
    if (::write(out, &figures, sizeof figures) != sizeof figures) return;
  }
}

}  // namespace

HostileCrowd::HostileCrowd() : process_(serve_orders) {}

void HostileCrowd::begin(const Door& door, double duration_s) { process_.send(Order{door, duration_s}); }

HostileFigures HostileCrowd::end() { return process_.receive<HostileFigures>(); }

}  // namespace ream::bench
