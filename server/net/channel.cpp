#include "net/channel.hpp"

#include <boost/asio/post.hpp>

namespace ream::net {
namespace asio = boost::asio;

Channel::Channel(Socket socket)
    : executor_(socket.get_executor()),
      socket_(std::make_unique<Socket>(std::move(socket))),
      pending_(std::make_shared<Pending>(executor_)) {}

Channel::Channel(Channel&& other) noexcept
    : executor_(other.executor_),
      socket_(std::move(other.socket_)),
      tls_(std::move(other.tls_)),
      on_received_(std::move(other.on_received_)),
      pending_(std::move(other.pending_)) {}

Channel::~Channel() = default;

void Channel::async_encrypt(TlsContext& context, asio::const_buffer already_read, EndHandler handler) {
  tls_ = std::make_unique<Tls>(*socket_, context.get());
  tls_->async_handshake(
      asio::ssl::stream_base::server, already_read,
      counted([handler = std::move(handler)](error_code failed, size_t) { handler(failed); }));
}

void Channel::async_end_sending(EndHandler handler) {
  auto ended = counted([handler = std::move(handler)](error_code failed, size_t) { handler(failed); });
  if (tls_) {
    tls_->async_shutdown([ended = std::move(ended)](error_code failed) { ended(failed, 0); });
    return;
  }
  error_code failed;
  socket_->shutdown(Socket::shutdown_send, failed);
  asio::post(executor_, [ended = std::move(ended), failed] { ended(failed, 0); });
}

void Channel::close() noexcept {
  error_code ignored;
  if (!socket_) return;
  socket_->close(ignored);
  pending_->closed = true;
  pending_->check();
}

void Channel::when_over(EndHandler over) { pending_->over = std::move(over); }

void Channel::Pending::end_one() {
  --operations;
  check();
}

/// What runs before the call may begin something again: then its end checks anew.
void Channel::Pending::check() {
  if (!idle() || !over) return;
  asio::post(executor, [self = shared_from_this()] {
    if (!self->idle()) return;
    if (const EndHandler call = std::exchange(self->over, nullptr)) call({});
  });
}

/// The handler may begin the next operation, so the count goes down only after it.
Channel::SomeHandler Channel::counted(SomeHandler handler) {
  ++pending_->operations;
  return [pending = pending_, handler = std::move(handler)](error_code failed, size_t bytes) {
    handler(failed, bytes);
    pending->end_one();
  };
}

void Channel::async_discard(asio::mutable_buffer into, SomeHandler handler) {
  socket_->async_read_some(into, counted(std::move(handler)));
}

void Channel::read_some(const MutableBuffers& into, SomeHandler handler) {
  if (on_received_)
    handler = [this, into, handler = std::move(handler)](error_code failed, size_t bytes) {
      show_received(into, bytes);
      handler(failed, bytes);
    };
  if (tls_)
    tls_->async_read_some(into, counted(std::move(handler)));
  else
    socket_->async_read_some(into, counted(std::move(handler)));
}

void Channel::write_some(const ConstBuffers& from, SomeHandler handler) {
  if (tls_)
    tls_->async_write_some(from, counted(std::move(handler)));
  else
    socket_->async_write_some(from, counted(std::move(handler)));
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
