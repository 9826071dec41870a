#include "net/channel.hpp"

#include <boost/asio/post.hpp>

namespace ream::net {
namespace asio = boost::asio;

Channel::Channel(Socket socket)
    : executor_(socket.get_executor()), socket_(std::make_unique<Socket>(std::move(socket))) {}

Channel::Channel(Channel&& other) noexcept
    : executor_(other.executor_),
      socket_(std::move(other.socket_)),
      tls_(std::move(other.tls_)),
      on_received_(std::move(other.on_received_)) {}

Channel::~Channel() = default;

void Channel::async_encrypt(TlsContext& context, asio::const_buffer already_read, EndHandler handler) {
  tls_ = std::make_unique<Tls>(*socket_, context.get());
  tls_->async_handshake(asio::ssl::stream_base::server, already_read,
                        [handler = std::move(handler)](error_code failed, size_t) { handler(failed); });
}

void Channel::async_end_sending(EndHandler handler) {
  if (tls_) {
    tls_->async_shutdown(std::move(handler));
    return;
  }
  error_code failed;
  socket_->shutdown(Socket::shutdown_send, failed);
  asio::post(executor_, [handler = std::move(handler), failed] { handler(failed); });
}

void Channel::close() noexcept {
  error_code ignored;
  if (socket_) socket_->close(ignored);
}

void Channel::read_some(const MutableBuffers& into, SomeHandler handler) {
  if (on_received_)
    handler = [this, into, handler = std::move(handler)](error_code failed, size_t bytes) {
      show_received(into, bytes);
      handler(failed, bytes);
    };
  if (tls_)
    tls_->async_read_some(into, std::move(handler));
  else
    socket_->async_read_some(into, std::move(handler));
}

void Channel::write_some(const ConstBuffers& from, SomeHandler handler) {
  if (tls_)
    tls_->async_write_some(from, std::move(handler));
  else
    socket_->async_write_some(from, std::move(handler));
}

void Channel::show_received(const MutableBuffers& buffers, size_t bytes) const {
  for (const asio::const_buffer piece : buffers) {
    const size_t here = std::min(bytes, piece.size());
    if (here == 0) return;
    on_received_({static_cast<const std::byte*>(piece.data()), here});
    bytes -= here;
  }
}

}  // namespace ream::net
