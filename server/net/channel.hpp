#pragma once
// Inside of net only.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <memory>

#include "net/tls_context.hpp"

namespace ream::net {

/// A socket's bytes, plain or under TLS: one type for both, so that all that goes over it is compiled once.
/// Moving it moves the connection; the one left behind is closed.
class Channel {
 public:
  using Socket = boost::asio::ip::tcp::socket;
  using executor_type = Socket::executor_type;
  using next_layer_type = Socket;
  using error_code = boost::system::error_code;

  explicit Channel(Socket socket)
      : executor_(socket.get_executor()), socket_(std::make_unique<Socket>(std::move(socket))) {}

  executor_type get_executor() const { return executor_; }
  Socket& next_layer() { return *socket_; }
  const Socket& next_layer() const { return *socket_; }
  bool encrypted() const { return tls_ != nullptr; }

  /// From here on all goes through TLS. `already_read`: what was read of the peer's handshake before.
  template <typename Handler>
  void async_encrypt(TlsContext& context, boost::asio::const_buffer already_read, Handler handler) {
    tls_ = std::make_unique<Tls>(*socket_, context.get());
    tls_->async_handshake(
        boost::asio::ssl::stream_base::server, already_read,
        [handler = std::move(handler)](error_code failed, size_t) mutable { handler(failed); });
  }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& into, Handler&& handler) {
    if (tls_)
      tls_->async_read_some(into, std::forward<Handler>(handler));
    else
      socket_->async_read_some(into, std::forward<Handler>(handler));
  }

  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& from, Handler&& handler) {
    if (tls_)
      tls_->async_write_some(from, std::forward<Handler>(handler));
    else
      socket_->async_write_some(from, std::forward<Handler>(handler));
  }

  /// Tells the peer that nothing more comes. With TLS the peer is waited for.
  template <typename Handler>
  void async_end_sending(Handler handler) {
    if (tls_) {
      tls_->async_shutdown(std::move(handler));
      return;
    }
    error_code failed;
    socket_->shutdown(Socket::shutdown_send, failed);
    boost::asio::post(executor_, [handler = std::move(handler), failed]() mutable { handler(failed); });
  }

  /// All that is pending ends with operation_aborted.
  void close() noexcept {
    error_code ignored;
    if (socket_) socket_->close(ignored);
  }

 private:
  using Tls = boost::asio::ssl::stream<Socket&>;

  executor_type executor_;
  std::unique_ptr<Socket> socket_;  ///< stays where it is when the channel moves
  std::unique_ptr<Tls> tls_;
};

/// What Beast asks of a stream that it does not know: how a WebSocket's connection ends after its last word.
template <typename Handler>
void async_teardown(boost::beast::role_type role, Channel& channel, Handler&& handler) {
  if (channel.encrypted())
    channel.async_end_sending(std::forward<Handler>(handler));
  else
    boost::beast::websocket::async_teardown(role, channel.next_layer(), std::forward<Handler>(handler));
}

}  // namespace ream::net
