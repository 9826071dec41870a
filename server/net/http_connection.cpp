#include <array>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <optional>
#include <utility>

#include "net/connections.hpp"
#include "net/guard.hpp"
#include "net/lingering_close.hpp"
#include "net/problem.hpp"
#include "net/reply_writer.hpp"
#include "net/request_parser.hpp"
#include "net/response_head.hpp"
#include "net/transfer_pace.hpp"
#include "net/watchdog.hpp"

namespace ream::net {
namespace asio = boost::asio;
using boost::system::error_code;
namespace {

constexpr unsigned char tls_handshake_byte = 0x16;  ///< RFC 8446, 5.1: what a TLS connection begins with
constexpr size_t body_read_bytes = 64 * 1024;

/// One HTTP/1.1 connection: read a request, have a worker answer it, write, again. Everything but the handler
/// runs on the socket's strand.
class HttpConnection final : public Connection, public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Engine& engine, Channel::Socket socket, Ends ends)
      : Connection(ends.peer_key),
        engine_(engine),
        ends_(std::move(ends)),
        channel_(std::move(socket)),
        watchdog_(channel_),
        writer_(engine, channel_, watchdog_),
        parser_(engine.limits) {}
  ~HttpConnection() override { engine_.connections.remove(this); }

  void start(bool refuse) {
    if (!engine_.connections.add(shared_from_this(), refuse)) return;
    asio::post(channel_.get_executor(), [self = shared_from_this(), refuse] {
      if (refuse && !self->engine_.tls)
        self->fail(503, "too many connections to this server; close some and try again");
      else if (refuse)
        self->watchdog_.close();
      else if (self->engine_.tls)
        self->await_handshake();
      else
        self->await_request();
    });
  }

  void shut_down() override {
    asio::post(channel_.get_executor(), [self = shared_from_this()] {
      self->ending_ = true;
      if (self->wait() != Wait::nothing) self->watchdog_.close();
    });
  }

  void abandon() noexcept override { watchdog_.close(); }

 private:
  void await_handshake() {
    set_wait(Wait::head);
    watchdog_.arm(engine_.limits.header, shared_from_this());
    channel_.async_read_some(asio::buffer(arrived_), [self = shared_from_this()](error_code failed,
                                                                                 size_t bytes) {
      if (failed)
        self->watchdog_.close();
      else if (static_cast<unsigned char>(self->arrived_.front()) != tls_handshake_byte)
        self->fail(400, "this port speaks TLS only: ask for it with https:// or wss://");
      else if (self->engine_.address_rate.take(self->address(), self->engine_.limits.handshake_cost) > 0.0)
        self->watchdog_.close();
      else
        self->shake_hands(bytes);
    });
  }

  void shake_hands(size_t bytes) {
    channel_.async_encrypt(*engine_.tls, asio::buffer(arrived_, bytes),
                           [self = shared_from_this()](error_code failed) {
                             if (failed)
                               self->watchdog_.close();
                             else
                               self->await_request();
                           });
  }

  void await_request() {
    if (ending_) {
      watchdog_.close();
      return;
    }
    if (parser_.stage() == RequestParser::Stage::nothing) {
      set_wait(Wait::request);
      watchdog_.arm(engine_.limits.idle, shared_from_this());
      read(asio::buffer(arrived_));
    } else {
      set_wait(Wait::head);
      watchdog_.arm(engine_.limits.header, shared_from_this());
      go_on();
    }
  }

  void read(asio::mutable_buffer into) {
    channel_.async_read_some(into, [self = shared_from_this(), into](error_code failed, size_t bytes) {
      if (failed)
        self->on_end(failed);
      else
        self->on_bytes({static_cast<const char*>(into.data()), bytes});
    });
  }

  void on_bytes(std::string_view bytes) {
    if (wait() == Wait::request) {
      set_wait(Wait::head);
      watchdog_.arm(engine_.limits.header, shared_from_this());
    }
    pace_.moved(bytes.size());
    try {
      parser_.feed(bytes);
    } catch (const RequestError& error) {
      fail(error.status(), error.what());
      return;
    }
    go_on();
  }

  /// As far as the request has come.
  void go_on() {
    const RequestParser::Stage stage = parser_.stage();
    if (stage >= RequestParser::Stage::body && wait() == Wait::head) {
      set_wait(Wait::body);
      if (on_head()) go_on();
    } else if (stage == RequestParser::Stage::whole) {
      answer();
    } else if (stage == RequestParser::Stage::body) {
      watchdog_.arm(pace_.patience(TransferPace::Clock::now()), shared_from_this());
      body_piece_.resize(body_read_bytes);
      read(asio::buffer(body_piece_));
    } else {
      read(asio::buffer(arrived_));
    }
  }

  /// False when the request goes no further, or not from here.
  bool on_head() {
    Request& request = parser_.request();
    request.peer = ends_.peer;
    request.encrypted = channel_.encrypted();
    keep_alive_ = parser_.keep_alive();
    head_only_ = request.method == "HEAD";
    const Limits& limits = engine_.limits;
    pace_ = TransferPace(TransferPace::Clock::now(), limits.body, limits.body, limits.least_bytes_per_s);
    const bool is_websocket = wants_websocket(request);
    if (auto refusal = refuse_foreign(request, is_websocket, {engine_.public_names, ends_.local})) {
      refuse(std::move(*refusal));
    } else if (const double wait_s = engine_.address_rate.take(address()); wait_s > 0.0) {
      refuse(too_many_requests("too many requests from " + ends_.peer + "; wait and send fewer", wait_s));
    } else if (!(body_lease_ = engine_.bodies.lend(parser_.announced_bytes().value_or(limits.body_bytes)))) {
      fail(503, "the server has too many request bodies to hold; try again");
    } else if (is_websocket) {
      open_websocket();
    } else if (parser_.wants_continue() && parser_.stage() == RequestParser::Stage::body) {
      say_continue();
    } else {
      return true;
    }
    return false;
  }

  void say_continue() {
    static constexpr std::string_view line = "HTTP/1.1 100 Continue\r\n\r\n";
    asio::async_write(channel_, asio::buffer(line), [self = shared_from_this()](error_code failed, size_t) {
      if (failed)
        self->watchdog_.close();
      else
        self->go_on();
    });
  }

  /// What the request needs no more while it is answered.
  void stop_waiting() {
    set_wait(Wait::nothing);
    watchdog_.disarm();
    body_piece_ = {};
  }

  void answer() {
    stop_waiting();
    Request request = std::move(parser_.request());
    request.body = parser_.take_body();
    const bool taken =
        engine_.workers.submit([self = shared_from_this(), request = std::move(request)]() mutable {
          Response response = self->engine_.router.respond(std::move(request));
          asio::post(self->channel_.get_executor(),
                     [self, response = std::move(response)]() mutable { self->write(std::move(response)); });
        });
    if (!taken) fail(503, "the server is busy; try again");
  }

  void open_websocket() {
    stop_waiting();
    const bool taken = engine_.workers.submit([self = shared_from_this()] {
      auto opened = std::make_shared<Router::Opened>(self->engine_.router.open(self->parser_.request()));
      asio::post(self->channel_.get_executor(), [self, opened] {
        if (!opened->session)
          self->write(std::move(opened->refusal));
        else if (!self->ending_)
          start_websocket(self->engine_, std::move(self->channel_), self->ends_,
                          std::move(self->parser_.request()), std::move(opened->session));
      });
    });
    if (!taken) fail(503, "the server is busy; try again");
  }

  /// The peer sends no more: say why there is no answer where there is still somebody to say it to.
  void on_end(error_code failed) {
    if (failed == asio::error::eof && wait() != Wait::request && wait() != Wait::nothing)
      fail(400, "the request ended before it was whole");
    else
      watchdog_.close();
  }

  void fail(int status, const std::string& detail) { refuse(problem(status, detail)); }

  /// Answers and ends: what else comes from this peer is not understood.
  void refuse(Response response) {
    keep_alive_ = false;
    write(std::move(response));
  }

  void write(Response response) {
    stop_waiting();
    keep_alive_ = keep_alive_ && !ending_;
    const bool with_body = !std::exchange(head_only_, false);
    writer_.send({weak_from_this(),
                  response_head(response, security_headers(channel_.encrypted()), keep_alive_),
                  with_body ? std::move(response.body) : nullptr,
                  with_body ? std::move(response.file) : std::nullopt, [this] { on_written(); }});
  }

  void on_written() {
    body_lease_ = {};
    if (!keep_alive_) {
      end();
      return;
    }
    try {
      parser_.next();
    } catch (const RequestError& error) {
      fail(error.status(), error.what());
      return;
    }
    await_request();
  }

  void end() { close_lingering(channel_, watchdog_, engine_.limits.linger, shared_from_this()); }

  Engine& engine_;
  const Ends ends_;
  Channel channel_;
  Watchdog watchdog_;
  ReplyWriter writer_;
  RequestParser parser_;
  std::array<char, 2048> arrived_;
  std::vector<char> body_piece_;
  ByteBudget::Lease body_lease_;
  TransferPace pace_;
  bool keep_alive_ = false;
  bool head_only_ = false;
  bool ending_ = false;
};

}  // namespace

void start_http(Engine& engine, Channel::Socket socket, Ends ends, bool refuse) {
  std::make_shared<HttpConnection>(engine, std::move(socket), std::move(ends))->start(refuse);
}

}  // namespace ream::net
