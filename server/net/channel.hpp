#pragma once
// Inside of net only.
#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/async_base.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/role.hpp>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "net/tls.hpp"

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
  /// The one left behind keeps its executor: somebody may still be about to ask it to close.
  Channel(Channel&& other) noexcept
      : executor_(other.executor_),
        socket_(std::move(other.socket_)),
        tls_(std::move(other.tls_)),
        on_received_(std::move(other.on_received_)) {}
  Channel& operator=(Channel&&) = delete;

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

  /// From here on `see` is told of all that is read, before its reader is, on the strand.
  void watch_received(std::function<void(std::span<const std::byte>)> see) { on_received_ = std::move(see); }

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& into, Handler&& handler) {
    if (on_received_)
      read_some(into,
                WatchedRead<std::decay_t<Handler>, Buffers>(std::forward<Handler>(handler), *this, into));
    else
      read_some(into, std::forward<Handler>(handler));
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

  /// A read whose bytes are shown to `on_received_` first.
  template <typename Handler, typename Buffers>
  class WatchedRead : public boost::beast::async_base<Handler, executor_type> {
   public:
    WatchedRead(Handler handler, Channel& channel, const Buffers& into)
        : boost::beast::async_base<Handler, executor_type>(std::move(handler), channel.get_executor()),
          channel_(channel),
          into_(into) {}

    void operator()(error_code failed, size_t bytes) {
      channel_.show_received(into_, bytes);
      this->complete_now(failed, bytes);
    }

   private:
    Channel& channel_;
    Buffers into_;
  };

  template <typename Buffers, typename Handler>
  void read_some(const Buffers& into, Handler&& handler) {
    if (tls_)
      tls_->async_read_some(into, std::forward<Handler>(handler));
    else
      socket_->async_read_some(into, std::forward<Handler>(handler));
  }

  template <typename Buffers>
  void show_received(const Buffers& buffers, size_t bytes) {
    for (auto at = boost::asio::buffer_sequence_begin(buffers);
         bytes > 0 && at != boost::asio::buffer_sequence_end(buffers); ++at) {
      const boost::asio::const_buffer piece = *at;
      const size_t here = std::min(bytes, piece.size());
      on_received_({static_cast<const std::byte*>(piece.data()), here});
      bytes -= here;
    }
  }

  executor_type executor_;
  std::unique_ptr<Socket> socket_;  ///< stays where it is when the channel moves
  std::unique_ptr<Tls> tls_;
  std::function<void(std::span<const std::byte>)> on_received_;
};

/// What Beast asks of a stream that it does not know: how a WebSocket's connection ends after its last word.
/// Nothing here: the connection does it, with Watchdog::close_lingering.
template <typename Handler>
void async_teardown(boost::beast::role_type, Channel& channel, Handler&& handler) {
  boost::asio::post(channel.get_executor(),
                    boost::beast::bind_front_handler(std::forward<Handler>(handler), Channel::error_code{}));
}

}  // namespace ream::net
