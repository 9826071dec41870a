#include "net/websocket_client.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include <vector>

#include "core/error.hpp"
#include "net/channel.hpp"

namespace ream::net {
namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
namespace {

constexpr size_t max_message_bytes = 1024 * 1024;
constexpr std::chrono::milliseconds close_timeout{200};

}  // namespace

struct WebSocketClient::Parts {
  asio::io_context io{1};
  websocket::stream<Channel, false> stream{Channel(tcp::socket(io))};
  boost::beast::flat_buffer incoming;
  std::string place;     ///< host and port, for people
  bool reading = false;  ///< a read is under way, across calls
  std::optional<error_code> read_result;
  bool open = false;

  tcp::socket& socket() { return stream.next_layer().next_layer(); }

  /// Lets `result` come about; false when it has not in its time.
  bool wait_for(const std::optional<error_code>& result, Milliseconds timeout) {
    const auto until = std::chrono::steady_clock::now() + timeout;
    io.restart();
    // What is there already counts also when there is no time to wait.
    while (!result && io.poll_one() > 0) {
    }
    while (!result && io.run_one_until(until) > 0) {
    }
    return result.has_value();
  }

  /// Starts something and waits for it. What has not ended in its time is broken off, with the connection.
  template <typename Start>
  error_code within(Milliseconds timeout, Start start) {
    std::optional<error_code> result;
    start([&result](error_code failed, auto&&...) { result = failed; });
    if (wait_for(result, timeout)) return *result;
    drop();
    while (!result) {
      io.restart();
      if (io.run_one() == 0) break;
    }
    return asio::error::timed_out;
  }

  void drop() {
    open = false;
    error_code ignored;
    socket().close(ignored);
  }

  [[noreturn]] void fail(const std::string& what, error_code failed) {
    drop();
    throw Error(ErrorKind::unavailable, place + " " + what + ": " + failed.message());
  }
};

/// Where a host was found.
struct WebSocketClient::ResolvedHost {
  std::string place;
  std::vector<tcp::endpoint> endpoints;
};

WebSocketClient::WebSocketClient() : parts_(std::make_unique<Parts>()) {}

WebSocketClient::~WebSocketClient() { close(); }

bool WebSocketClient::is_open() const noexcept { return parts_->open; }

void WebSocketClient::connect(const std::string& host, uint16_t port, const std::string& target,
                              Milliseconds timeout) {
  const std::string place = host + ":" + std::to_string(port);
  try {
    parts_ = std::make_unique<Parts>();
    parts_->place = place;
    if (resolved_ == nullptr || resolved_->place != place) resolve(host, port, timeout);
    handshake(target, timeout);
  } catch (const boost::system::system_error& e) {
    parts_->drop();
    throw Error(ErrorKind::unavailable, place + " cannot be reached: " + e.code().message());
  }
}

void WebSocketClient::resolve(const std::string& host, uint16_t port, Milliseconds timeout) {
  Parts& parts = *parts_;
  tcp::resolver resolver(parts.io);
  tcp::resolver::results_type found;
  std::optional<error_code> resolved;
  resolver.async_resolve(host, std::to_string(port),
                         [&](error_code failed, const tcp::resolver::results_type& results) {
                           found = results;
                           resolved = failed;
                         });
  if (!parts.wait_for(resolved, timeout)) {
    resolver.cancel();
    parts.io.restart();
    parts.io.run();
    parts.fail("was not found", asio::error::timed_out);
  }
  if (*resolved) parts.fail("was not found", *resolved);
  resolved_ = std::make_unique<ResolvedHost>(ResolvedHost{parts.place, {found.begin(), found.end()}});
}

void WebSocketClient::handshake(const std::string& target, Milliseconds timeout) {
  Parts& parts = *parts_;
  if (const error_code failed = parts.within(timeout, [&](auto done) {
        asio::async_connect(parts.socket(), resolved_->endpoints, std::move(done));
      }))
    parts.fail("cannot be reached", failed);
  error_code ignored;
  parts.socket().set_option(tcp::no_delay(true), ignored);
  parts.stream.read_message_max(max_message_bytes);
  parts.stream.text(true);
  parts.stream.auto_fragment(false);
  if (const error_code failed = parts.within(
          timeout, [&](auto done) { parts.stream.async_handshake(parts.place, target, std::move(done)); }))
    parts.fail("speaks no WebSocket", failed);
  parts.open = true;
}

void WebSocketClient::send(std::string_view text, Milliseconds timeout) {
  Parts& parts = *parts_;
  if (!parts.open) parts.fail("is not connected", asio::error::not_connected);
  if (const error_code failed = parts.within(timeout, [&](auto done) {
        parts.stream.async_write(asio::buffer(text.data(), text.size()), std::move(done));
      }))
    parts.fail("takes no message", failed);
}

std::optional<std::string_view> WebSocketClient::receive(Milliseconds timeout) {
  Parts& parts = *parts_;
  if (!parts.open) parts.fail("is not connected", asio::error::not_connected);
  if (!parts.reading) {
    parts.incoming.clear();
    parts.read_result.reset();
    parts.reading = true;
    parts.stream.async_read(parts.incoming,
                            [&parts](error_code failed, size_t) { parts.read_result = failed; });
  }
  if (!parts.wait_for(parts.read_result, timeout)) return std::nullopt;
  parts.reading = false;
  if (*parts.read_result) parts.fail("has ended the connection", *parts.read_result);
  const auto data = parts.incoming.cdata();
  return std::string_view(static_cast<const char*>(data.data()), data.size());
}

void WebSocketClient::close() noexcept {
  Parts& parts = *parts_;
  if (!parts.open) return;
  try {
    parts.within(close_timeout, [&](auto done) {
      parts.stream.async_close(websocket::close_code::normal, std::move(done));
    });
    parts.drop();
  } catch (const std::exception&) {
    // The connection ends with the socket, said goodbye or not.
  }
}

}  // namespace ream::net
