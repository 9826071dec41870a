#include "net/listener.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/periodic_task.hpp"
#include "core/signal_handlers.hpp"
#include "net/engine.hpp"
#include "net/guard.hpp"

namespace ream::net {
namespace asio = boost::asio;
using asio::ip::tcp;
namespace {

tcp::endpoint endpoint_of(const ListenOptions& options) {
  if (!options.beyond_loopback && !is_loopback_host(options.host))
    throw Error(ErrorKind::usage,
                "--host " + options.host +
                    ": without users the server binds to this machine only; use 127.0.0.1, ::1 or "
                    "localhost");
  boost::system::error_code failed;
  const auto address =
      asio::ip::make_address(options.host == "localhost" ? "127.0.0.1" : options.host, failed);
  if (failed)
    throw Error(ErrorKind::usage,
                "--host " + options.host +
                    " is no address; give one of this machine, or 0.0.0.0 for all of them, and "
                    "the name people use with --public-name");
  return {address, options.port};
}

/// What waits for a slow peer waits in the program, where newer takes the place of older, and not in the
/// kernel's queue, where it grows old: the kernel takes this many bytes that it cannot send yet, and no more.
void limit_unsent(tcp::socket& socket) {
  constexpr int max_bytes = 16 * 1024;
  // Without it a slow viewer's picture is only later.
  static_cast<void>(
      ::setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &max_bytes, sizeof max_bytes));
}

[[noreturn]] void refuse_to_listen(const boost::system::error_code& failed, const ListenOptions& options) {
  const std::string place = "port " + std::to_string(options.port) + " on " + options.host;
  if (failed == asio::error::address_in_use)
    throw Error(ErrorKind::unavailable, place + " is in use; choose another with --port");
  if (failed == boost::system::errc::address_not_available)
    throw Error(ErrorKind::unavailable,
                "--host " + options.host +
                    " is no address of this machine; give one that is, or 0.0.0.0 for all of them");
  if (failed == boost::system::errc::permission_denied)
    throw Error(ErrorKind::unavailable, place + " needs privileges; choose another with --port");
  throw Error(ErrorKind::unavailable,
              place + " cannot be used: " + failed.message() + "; choose another with --port");
}

void open(tcp::acceptor& acceptor, const ListenOptions& options) {
  const tcp::endpoint endpoint = endpoint_of(options);
  boost::system::error_code failed;
  acceptor.open(endpoint.protocol(), failed);
  if (!failed) acceptor.set_option(asio::socket_base::reuse_address(true), failed);
  if (!failed) acceptor.bind(endpoint, failed);
  if (!failed) acceptor.listen(asio::socket_base::max_listen_connections, failed);
  if (failed) refuse_to_listen(failed, options);
}

/// An IPv4 address that came through an IPv6 socket is an IPv4 address.
asio::ip::address plain_address(const asio::ip::address& address) {
  if (!address.is_v6() || !address.to_v6().is_v4_mapped()) return address;
  return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
}

std::string text_of(const asio::ip::address& address) {
  const std::string text = address.to_string();
  return text.substr(0, text.find('%'));
}

}  // namespace

Ends ends_of(const Channel::Socket& socket) {
  boost::system::error_code failed;
  const auto peer = plain_address(socket.remote_endpoint(failed).address());
  const auto local = plain_address(socket.local_endpoint(failed).address());
  const std::string address = text_of(peer);
  return {address, text_of(local), limit_key(address)};
}

struct Listener::Parts {
  Parts(const Router& router, const ListenOptions& options)
      : engine(router, options.limits, options.io_threads, options.worker_threads),
        until_stopped(engine.io.get_executor()),
        acceptor(asio::make_strand(engine.io)),
        pause(acceptor.get_executor()),
        io_threads(options.io_threads) {
    for (const std::string& name : options.public_names) engine.public_names.push_back(plain_host(name));
    engine.proxies = TrustedProxies(options.trusted_proxies);
    if (options.tls) engine.tls = std::make_shared<RenewedTls>(*options.tls);
    open(acceptor, options);
    if (engine.tls && !engine.tls->current()->warning().empty()) log::warn(engine.tls->current()->warning());
    look_at_certificate_every = options.look_at_certificate_every;
    bound_port = acceptor.local_endpoint().port();
  }

  void accept() {
    acceptor.async_accept(asio::make_strand(engine.io),
                          [this](boost::system::error_code failed, tcp::socket socket) {
                            if (!acceptor.is_open()) return;
                            if (failed) {
                              accept_later(failed);
                              return;
                            }
                            accept();
                            start_connection(std::move(socket));
                          });
  }

  void start_connection(tcp::socket socket) {
    using Place = ConnectionRegistry::Place;
    Ends ends = ends_of(socket);
    if (engine.proxies.trusts(ends.peer)) ends.peer_key.clear();
    const Place place = engine.connections.make_room(ends.peer_key, engine.limits);
    if (place == Place::overfull) return;
    boost::system::error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    limit_unsent(socket);
    start_http(engine, std::move(socket), std::move(ends), place == Place::busy);
  }

  /// Out of file descriptors, say: trying again at once would only spin.
  void accept_later(const boost::system::error_code& failed) {
    log::warn("a connection could not be taken: " + failed.message());
    pause.expires_after(std::chrono::milliseconds(100));
    pause.async_wait([this](boost::system::error_code cancelled) {
      if (!cancelled && acceptor.is_open()) accept();
    });
  }

  void run_io() {
    for (;;) {
      try {
        engine.io.run();
        return;
      } catch (...) {
        log::current_exception("a connection failed");
      }
    }
  }

  /// What still lies in the queues holds sockets, an accepted one say: their peers must not wait for ever.
  void drop_pending() {
    engine.io.restart();
    try {
      engine.io.poll();
    } catch (...) {
      log::current_exception("a connection failed at the end");
    }
  }

  std::chrono::milliseconds look_at_certificate_every{};
  Engine engine;
  PeriodicTask certificate{"certificate", [this] {
                             engine.tls->look();
                             return look_at_certificate_every;
                           }};
  /// While a handler runs, its connection has nothing pending: the I/O threads must not take that for the
  /// end.
  asio::executor_work_guard<asio::io_context::executor_type> until_stopped;
  tcp::acceptor acceptor;
  asio::steady_timer pause;
  size_t io_threads;
  uint16_t bound_port = 0;
  std::vector<std::thread> threads;
  bool stopped = false;
};

Listener::Listener(const Router& router, const ListenOptions& options)
    : parts_(std::make_unique<Parts>(router, options)) {}

Listener::~Listener() { stop(); }

uint16_t Listener::port() const { return parts_->bound_port; }

void Listener::start() {
  asio::post(parts_->acceptor.get_executor(), [parts = parts_.get()] { parts->accept(); });
  parts_->threads.reserve(parts_->io_threads);
  if (parts_->engine.tls) parts_->certificate.start(parts_->look_at_certificate_every);
  for (size_t i = 0; i < parts_->io_threads; ++i)
    parts_->threads.push_back(start_thread([parts = parts_.get()] { parts->run_io(); }));
}

void Listener::stop() {
  if (parts_->stopped) return;
  parts_->stopped = true;
  parts_->certificate.stop();
  Engine& engine = parts_->engine;
  asio::post(parts_->acceptor.get_executor(), [parts = parts_.get()] {
    boost::system::error_code ignored;
    parts->acceptor.close(ignored);
    parts->pause.cancel();
  });
  engine.connections.close();
  for (const auto& connection : engine.connections.all()) connection->shut_down();
  if (!parts_->threads.empty() && !engine.connections.wait_until_empty(engine.limits.stop))
    log::warn("connections were cut that did not end in time");
  engine.workers.stop();
  engine.file_readers.stop();
  engine.io.stop();
  for (std::thread& thread : parts_->threads) thread.join();
  boost::system::error_code ignored;
  parts_->acceptor.close(ignored);  // the threads may have ended before they came to it
  for (const auto& connection : engine.connections.all()) connection->abandon();
  parts_->drop_pending();
}

}  // namespace ream::net
