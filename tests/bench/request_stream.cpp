#include "bench/request_stream.hpp"

#include <unistd.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bench/measure.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "support/raw_http.hpp"

namespace ream::bench {
namespace {

constexpr int workers = 4;

struct Order {
  Door door;
  double requests_per_s = 0.0, duration_s = 0.0;
};

struct PlannedRequest {
  const char* method;
  std::string target, body;
  int status;
};

/// What is asked in turn: every twentieth request changes something.
std::vector<PlannedRequest> requests_of(const Door& door) {
  const std::string sessions = "/api/v1/sessions", one = door.session_path();
  std::vector<PlannedRequest> requests;
  const auto get = [&](const std::string& target, int times = 1) {
    for (int i = 0; i < times; ++i) requests.push_back({"GET", target, "", 200});
  };
  get(one, 6);
  get(sessions + "?limit=50");
  get(sessions + "?limit=20&state=fault,interrupted");
  get(sessions + "?limit=20&trainee=u17&sort=-duration_s");
  get(sessions + "?limit=20&q=second%20try");
  get(one + "/metrics", 2);
  get(one + "/annotations", 2);
  get("/api/v1/cases");
  get("/api/v1/users");
  get("/metrics");
  get("/api/v1/openapi.yaml");
  get("/healthz");
  requests.push_back({"POST", one + "/annotations", R"({"words": "Look at the rim"})", 201});
  return requests;
}

/// One of the workers: every `workers`th request, on one connection, or on one of its own for each.
class Worker {
 public:
  Worker(const Order& order, int number, SteadyClock::time_point start)
      : order_(order), number_(number), keeps_connection_(number % 2 == 0), start_(start) {}

  void work() {
    const std::vector<PlannedRequest> requests = requests_of(order_.door);
    const auto count = static_cast<size_t>(order_.requests_per_s * order_.duration_s);
    for (size_t i = static_cast<size_t>(number_); i < count; i += workers) {
      const auto due =
          start_ + std::chrono::duration_cast<SteadyClock::duration>(
                       std::chrono::duration<double>(static_cast<double>(i) / order_.requests_per_s));
      std::this_thread::sleep_until(due);
      if (!ask(requests[(i / workers * 7 + i) % requests.size()])) ++failed;
      times_ms.push_back(elapsed_us(due) * 1e-3);
    }
  }

  std::vector<double> times_ms;
  uint64_t failed = 0;

 private:
  bool ask(const PlannedRequest& planned) {
    try {
      if (!socket_ || !keeps_connection_) socket_ = std::make_unique<test::RawSocket>(order_.door.port);
      std::string head = std::string(planned.method) + " " + planned.target +
                         " HTTP/1.1\r\nHost: localhost\r\nAuthorization: " + order_.door.authorization() +
                         "\r\n";
      if (!planned.body.empty())
        head += "Content-Type: application/json\r\nContent-Length: " + std::to_string(planned.body.size()) +
                "\r\n";
      socket_->send(head + "\r\n" + planned.body);
      const auto reply = test::receive_reply(*socket_);
      const bool good = reply.status == planned.status;
      if (!good)
        fprintf(stderr, "%s %s %d %s\n", planned.method, planned.target.c_str(), reply.status,
                reply.body.substr(0, 200).c_str());
      if (!good) socket_.reset();
      return good;
    } catch (const std::runtime_error&) {
      socket_.reset();
      return false;
    }
  }

  const Order& order_;
  const int number_;
  const bool keeps_connection_;
  const SteadyClock::time_point start_;
  std::unique_ptr<test::RawSocket> socket_;
};

RequestFigures ask_all(const Order& order) {
  const auto start = SteadyClock::now();
  std::vector<Worker> drivers;
  for (int i = 0; i < workers; ++i) drivers.emplace_back(order, i, start);
  std::vector<std::thread> threads;
  for (Worker& worker : drivers) threads.emplace_back([&worker] { worker.work(); });
  for (std::thread& thread : threads) thread.join();
  RequestFigures figures;
  figures.duration_s = elapsed_us(start) * 1e-6;
  std::vector<double> times_ms;
  for (const Worker& worker : drivers) {
    times_ms.insert(times_ms.end(), worker.times_ms.begin(), worker.times_ms.end());
    figures.failed += worker.failed;
  }
  figures.asked = times_ms.size();
  figures.p50_ms = percentile_of(times_ms, 0.5);
  figures.p95_ms = percentile_of(times_ms, 0.95);
  figures.p99_ms = percentile_of(times_ms, 0.99);
  return figures;
}

void serve_orders(int in, int out) {
  Order order;
  while (::read(in, &order, sizeof order) == sizeof order) {
    const RequestFigures figures = ask_all(order);
    if (::write(out, &figures, sizeof figures) != sizeof figures) return;
  }
}

}  // namespace

RequestStream::RequestStream() : process_(serve_orders) {}

void RequestStream::begin(const Door& door, double requests_per_s, double duration_s) {
  process_.send(Order{door, requests_per_s, duration_s});
}

RequestFigures RequestStream::end() {
  const RequestFigures figures = process_.receive<RequestFigures>();
  if (figures.asked == 0 || figures.failed == figures.asked)
    throw Error(ErrorKind::unavailable, "the server answered no request");
  return figures;
}

}  // namespace ream::bench
