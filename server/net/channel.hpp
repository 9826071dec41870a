#pragma once
// Inside of net only.
#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/role.hpp>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "net/tls.hpp"

namespace ream::net {

/// The first few of any sequence of buffers: enough for whoever reads or writes "some".
template <typename Buffer>
class BufferList {
 public:
  template <typename Buffers>
  explicit BufferList(const Buffers& all) {
    const auto end = boost::asio::buffer_sequence_end(all);
    for (auto at = boost::asio::buffer_sequence_begin(all); at != end && size_ < buffers_.size(); ++at)
      if (const Buffer buffer = *at; buffer.size() > 0) buffers_[size_++] = buffer;
  }

  const Buffer* begin() const { return buffers_.data(); }
  const Buffer* end() const { return buffers_.data() + size_; }

 private:
  std::array<Buffer, 8> buffers_;
  size_t size_ = 0;
};

/// A socket's bytes, plain or under TLS. What goes over it is of one type, whoever asks, so that sockets and
/// TLS are compiled once, here. Moving it moves the connection; the one left behind is closed.
/// Handlers are called on the socket's executor.
class Channel {
 public:
  using Socket = boost::asio::ip::tcp::socket;
  using executor_type = Socket::executor_type;
  using next_layer_type = Socket;
  using error_code = boost::system::error_code;
  using EndHandler = std::function<void(error_code)>;
  using SomeHandler = std::function<void(error_code, size_t)>;

  explicit Channel(Socket socket);
  /// The one left behind keeps its executor: somebody may still be about to ask it to close.
  Channel(Channel&& other) noexcept;
  Channel& operator=(Channel&&) = delete;
  ~Channel();

  executor_type get_executor() const { return executor_; }
  Socket& next_layer() { return *socket_; }
  const Socket& next_layer() const { return *socket_; }
  bool encrypted() const { return tls_ != nullptr; }

  /// From here on all goes through TLS. `already_read`: what was read of the peer's handshake before.
  void async_encrypt(TlsContext& context, boost::asio::const_buffer already_read, EndHandler handler);

  /// From here on `see` is told of all that is read, before its reader is, on the strand.
  void watch_received(std::function<void(std::span<const std::byte>)> see) { on_received_ = std::move(see); }

  /// As a stream of asio's: the handler gets the error and the number of bytes, once.
  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& into, Handler&& handler) {
    read_some(MutableBuffers(into), shared(std::forward<Handler>(handler)));
  }
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& from, Handler&& handler) {
    write_some(ConstBuffers(from), shared(std::forward<Handler>(handler)));
  }

  /// Tells the peer that nothing more comes. With TLS the peer is waited for.
  void async_end_sending(EndHandler handler);

  /// Reads what comes below TLS, for nobody.
  void async_discard(boost::asio::mutable_buffer into, SomeHandler handler);

  /// All that is pending ends with operation_aborted.
  void close() noexcept;

  /// `over` is called once, when the channel is closed and nothing is pending on it: from then on it may be
  /// destroyed, though somebody may still wait for a turn that never comes.
  void when_over(EndHandler over);

 private:
  /// Outlives the channel: a handler may destroy it.
  struct Pending : std::enable_shared_from_this<Pending> {
    explicit Pending(executor_type of) : executor(std::move(of)) {}
    executor_type executor;
    size_t operations = 0;
    bool closed = false;
    EndHandler over;

    void end_one();
    void check();
    bool idle() const { return closed && operations == 0; }
  };
  using Tls = boost::asio::ssl::stream<Socket&>;
  using MutableBuffers = BufferList<boost::asio::mutable_buffer>;
  using ConstBuffers = BufferList<boost::asio::const_buffer>;

  /// Handlers can be moved only, functions are copied.
  template <typename Handler>
  static SomeHandler shared(Handler&& handler) {
    return [own = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler))](error_code failed,
                                                                                           size_t bytes) {
      auto called = std::move(*own);
      called(failed, bytes);
    };
  }

  SomeHandler counted(SomeHandler handler);
  void read_some(const MutableBuffers& into, SomeHandler handler);
  void write_some(const ConstBuffers& from, SomeHandler handler);
  void show_received(const MutableBuffers& buffers, size_t bytes) const;

  executor_type executor_;
  std::unique_ptr<Socket> socket_;  ///< stays where it is when the channel moves
  std::unique_ptr<Tls> tls_;
  std::function<void(std::span<const std::byte>)> on_received_;
  std::shared_ptr<Pending> pending_;
};

/// What Beast asks of a stream that it does not know: how a WebSocket's connection ends after its last word.
/// Nothing here: the connection does it, with Watchdog::close_lingering.
template <typename Handler>
void async_teardown(boost::beast::role_type, Channel& channel, Handler&& handler) {
  boost::asio::post(channel.get_executor(),
                    boost::beast::bind_front_handler(std::forward<Handler>(handler), Channel::error_code{}));
}

}  // namespace ream::net
