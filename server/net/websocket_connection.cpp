#include <atomic>
#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/websocket.hpp>
#include <mutex>
#include <span>

#include "core/log.hpp"
#include "net/engine.hpp"
#include "net/frame_meter.hpp"
#include "net/guard.hpp"
#include "net/watchdog.hpp"

namespace ream::net {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;
namespace {

constexpr size_t max_reason_bytes = 123;      ///< bytes, RFC 6455, 5.5
constexpr double bytes_per_message = 1024.0;  ///< of Limits::websocket_messages

/// The handshake must be read before this connection exists, so it is rebuilt from what the router saw.
http::request<http::empty_body> handshake_of(const Request& request) {
  http::request<http::empty_body> handshake{http::verb::get, request.path, 11};
  for (const auto& [name, value] : request.headers) handshake.set(name, value);
  return handshake;
}

class WebSocketConnection final : public Connection,
                                  public std::enable_shared_from_this<WebSocketConnection> {
 public:
  WebSocketConnection(Engine& engine, Channel channel, Ends ends, std::unique_ptr<WebSocketSession> session)
      : Connection(std::move(ends.peer_key)),
        engine_(engine),
        session_(std::move(session)),
        executor_(channel.get_executor()),
        stream_(std::in_place, std::move(channel)),
        watchdog_(stream_->next_layer()),
        messages_(engine.limits.websocket_messages, TokenBucket::Clock::now()),
        wake_(std::make_shared<WakeHandle>()) {}

  ~WebSocketConnection() override {
    notify_closed();
    engine_.connections.remove(this);
  }

  void start(const Request& request) {
    if (!engine_.connections.add(shared_from_this())) return;
    // The stream's own timeouts find peers that vanished (unanswered pings); the watchdog finds those that
    // stay but do not read.
    auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.idle_timeout = engine_.limits.idle;
    timeouts.keep_alive_pings = true;
    stream_->set_option(timeouts);
    const bool encrypted = request.encrypted;
    stream_->set_option(websocket::stream_base::decorator([encrypted](websocket::response_type& response) {
      for (const auto& [name, value] : security_headers(encrypted)) response.set(name, value);
    }));
    stream_->next_layer().watch_received([this](std::span<const std::byte> bytes) { take_from_rate(bytes); });
    stream_->next_layer().when_over([weak = weak_from_this()](error_code) {
      if (const auto self = weak.lock()) self->drop_stream();
    });
    stream_->read_message_max(engine_.limits.websocket_message_bytes);
    stream_->auto_fragment(false);
    stream_->text(session_->sends_text());
    stream_->async_accept(handshake_of(request), [self = shared_from_this()](error_code failed) {
      if (!failed) self->on_accepted();
    });
  }

  void shut_down() override {
    asio::post(executor_, [self = shared_from_this()] { self->close(websocket::close_code::going_away); });
  }

  void abandon() noexcept override { finish(); }

 private:
  /// How other threads reach this connection, and how they stop reaching it.
  struct WakeHandle {
    std::mutex mutex;
    WebSocketConnection* connection = nullptr;
    std::atomic<bool> requested{false};
  };

  void on_accepted() {
    if (finished_) return;
    accepted_ = true;
    wake_->connection = this;
    guarded([this] {
      session_->on_open([handle = wake_] {
        if (handle->requested.exchange(true)) return;
        const std::lock_guard lock(handle->mutex);
        if (handle->connection) handle->connection->post_send_next();
      });
    });
    read();
    send_next();
  }

  /// With the wake handle held. The last owner may be on its way out: then there is nobody to wake.
  void post_send_next() {
    if (auto self = weak_from_this().lock())
      asio::post(executor_, [self = std::move(self)] {
        self->wake_->requested = false;
        self->send_next();
      });
  }

  void send_next() {
    if (writing_ || closing_ || finished_) return;
    std::optional<SharedBytes> message;
    guarded([&] { message = session_->next(); });
    if (!message || !*message) close_if_ended();
    if (!message || !*message || closing_) return;
    outgoing_ = std::move(*message);
    writing_ = true;
    watchdog_.arm(engine_.limits.write, shared_from_this());
    stream_->async_write(
        asio::buffer(outgoing_->data(), outgoing_->size()),
        [self = shared_from_this()](error_code failed, size_t) { self->on_written(failed); });
  }

  void close_if_ended() {
    std::optional<CloseReason> close_reason;
    guarded([&] { close_reason = session_->close_reason(); });
    if (close_reason)
      close({static_cast<websocket::close_code>(close_reason->code),
             beast::string_view(close_reason->text).substr(0, max_reason_bytes)});
  }

  void on_written(error_code failed) {
    writing_ = false;
    outgoing_.reset();
    if (closing_ || finished_) return;
    if (failed) {  // a read that found the peer in the wrong is saying goodbye, or will find the socket
                   // broken
      close_within_linger();
      return;
    }
    watchdog_.disarm();
    send_next();
  }

  void read() {
    stream_->async_read_some(incoming_, 0, [self = shared_from_this()](error_code failed, size_t) {
      if (failed)
        self->end();
      else
        self->on_piece();
    });
  }

  void on_piece() {
    if (closing_ || finished_) return;
    if (stream_->is_message_done()) {
      const auto data = incoming_.data();
      guarded([&] { session_->on_message({static_cast<const std::byte*>(data.data()), data.size()}); });
      incoming_.consume(incoming_.size());
    }
    // What is still pending ends by the closing handshake, which reads by itself.
    if (!closing_) read();
  }

  /// Every frame counts, those too that never become a message.
  void take_from_rate(std::span<const std::byte> bytes) {
    const double cost =
        static_cast<double>(frames_.count(bytes)) + static_cast<double>(bytes.size()) / bytes_per_message;
    if (messages_.take(cost, TokenBucket::Clock::now()) <= 0.0) return;
    // In the middle of a read: what follows from it must wait.
    asio::post(executor_, [self = shared_from_this()] {
      self->close({websocket::close_code::policy_error, "too many messages"});
    });
  }

  template <typename Call>
  void guarded(Call&& call) {
    try {
      call();
    } catch (const std::exception& failure) {
      log::error(std::string("a stream failed: ") + failure.what());
      close(websocket::close_code::internal_error);
    }
  }

  void close(const websocket::close_reason& reason) {
    if (closing_ || finished_) return;
    if (!accepted_) {  // no closing handshake before the opening one is over
      finish();
      return;
    }
    close_within_linger();
    stream_->async_close(reason, [self = shared_from_this()](error_code) { self->end(); });
  }

  void close_within_linger() {
    if (closing_ || finished_) return;
    closing_ = true;
    notify_closed();
    watchdog_.arm(engine_.limits.linger, shared_from_this());
  }

  /// After the WebSocket's last word.
  void end() {
    if (finished_) return;
    finished_ = true;
    notify_closed();
    watchdog_.close_lingering(engine_.limits.linger, shared_from_this());
  }

  /// At once.
  void finish() noexcept {
    finished_ = true;
    notify_closed();
    if (stream_) watchdog_.close();
  }

  /// The channel is closed and nothing is pending on it. A stream whose reader found the peer in the wrong
  /// while a close was on its way waits for ever, each for the other, and both own this connection.
  void drop_stream() noexcept {
    finished_ = true;
    notify_closed();
    watchdog_.disarm();
    stream_.reset();
  }

  /// The session hears of the end, once, and is not called again.
  void notify_closed() noexcept {
    if (session_closed_) return;
    session_closed_ = true;
    {
      const std::lock_guard lock(wake_->mutex);
      wake_->connection = nullptr;
    }
    session_->on_close();
  }

  Engine& engine_;
  std::unique_ptr<WebSocketSession> session_;
  const Channel::executor_type executor_;
  std::optional<websocket::stream<Channel, false>> stream_;  ///< none: over
  Watchdog watchdog_;
  TokenBucket messages_;
  FrameMeter frames_;
  beast::flat_buffer incoming_;
  SharedBytes outgoing_;
  std::shared_ptr<WakeHandle> wake_;
  bool accepted_ = false;
  bool writing_ = false;
  bool closing_ = false;
  bool finished_ = false;
  bool session_closed_ = false;
};

}  // namespace

void start_websocket(Engine& engine, Channel channel, Ends ends, Request request,
                     std::unique_ptr<WebSocketSession> session) {
  std::make_shared<WebSocketConnection>(engine, std::move(channel), std::move(ends), std::move(session))
      ->start(request);
}

}  // namespace ream::net
