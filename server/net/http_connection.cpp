#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <cctype>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "net/connections.hpp"
#include "net/file_body.hpp"
#include "net/guard.hpp"
#include "net/problem.hpp"
#include "net/response_head.hpp"
#include "net/watchdog.hpp"

namespace ream::net {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;
namespace {

using Parser = http::request_parser<http::string_body>;

std::string text(beast::string_view view) { return {view.data(), view.size()}; }

std::string lower(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

Request request_of(const Parser::value_type& message) {
  Request request;
  request.method = text(message.method_string());
  for (const auto& field : message) {
    std::string& value = request.headers[lower(text(field.name_string()))];
    if (!value.empty()) value += ", ";
    value += text(field.value());
  }
  const beast::string_view target = message.target();
  set_target(request, {target.data(), target.size()});
  return request;
}

bool wants_websocket(const Request& request) {
  return request.method == "GET" && lower(std::string(request.header("upgrade"))) == "websocket";
}

/// One HTTP/1.1 connection: read a request, have a worker answer it, write, again. Everything but the handler
/// runs on the socket's strand.
class HttpConnection final : public Connection, public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Engine& engine, tcp::socket socket)
      : engine_(engine),
        socket_(std::move(socket)),
        watchdog_(socket_),
        buffer_(engine.limits.header_bytes + 65536) {}
  ~HttpConnection() override { engine_.connections.remove(this); }

  void start(bool refuse) {
    if (!engine_.connections.add(shared_from_this())) return;
    error_code ignored;
    socket_.set_option(tcp::no_delay(true), ignored);
    peer_ = socket_.remote_endpoint(ignored).address().to_string();
    asio::post(socket_.get_executor(), [self = shared_from_this(), refuse] {
      if (refuse)
        self->fail(503, "too many connections to this server; close some and try again");
      else
        self->read_head();
    });
  }

  void shut_down() override {
    asio::post(socket_.get_executor(), [self = shared_from_this()] {
      self->ending_ = true;
      if (self->reading_) self->watchdog_.close();
    });
  }

  void abandon() noexcept override { watchdog_.close(); }

 private:
  void read_head() {
    if (ending_) return;
    parser_.emplace();
    parser_->header_limit(static_cast<uint32_t>(engine_.limits.header_bytes));
    parser_->body_limit(engine_.limits.body_bytes);
    reading_ = true;
    watchdog_.arm(engine_.limits.idle, shared_from_this());
    http::async_read_header(socket_, buffer_, *parser_,
                            [self = shared_from_this()](error_code failed, size_t) {
                              if (failed)
                                self->explain_bad_request(failed);
                              else
                                self->on_head();
                            });
  }

  void on_head() {
    const auto& head = parser_->get();
    keep_alive_ = head.keep_alive();
    try {
      request_ = request_of(head);
      request_.peer = peer_;
    } catch (const RequestError& error) {
      fail(error.status(), error.what());
      return;
    }
    const bool is_websocket = wants_websocket(request_);
    if (auto refusal = refuse_foreign(request_, is_websocket)) {
      keep_alive_ = false;
      write(std::move(*refusal));
    } else if (is_websocket) {
      open_websocket();
    } else if (beast::iequals(head[http::field::expect], "100-continue")) {
      say_continue();
    } else {
      read_body();
    }
  }

  void say_continue() {
    static constexpr std::string_view line = "HTTP/1.1 100 Continue\r\n\r\n";
    asio::async_write(socket_, asio::buffer(line), [self = shared_from_this()](error_code failed, size_t) {
      if (!failed) self->read_body();
    });
  }

  void read_body() {
    http::async_read(socket_, buffer_, *parser_, [self = shared_from_this()](error_code failed, size_t) {
      if (failed) {
        self->explain_bad_request(failed);
        return;
      }
      self->reading_ = false;
      self->watchdog_.disarm();
      self->request_.body = std::move(self->parser_->get().body());
      self->answer();
    });
  }

  void answer() {
    const bool taken =
        engine_.workers.submit([self = shared_from_this(), request = std::move(request_)]() mutable {
          self->head_only_ = request.method == "HEAD";
          Response response = self->engine_.router.respond(std::move(request));
          asio::post(self->socket_.get_executor(),
                     [self, response = std::move(response)]() mutable { self->write(std::move(response)); });
        });
    if (!taken) fail(503, "the server is busy; try again");
  }

  void open_websocket() {
    reading_ = false;
    watchdog_.disarm();
    const bool taken = engine_.workers.submit([self = shared_from_this()] {
      auto opened = std::make_shared<Router::Opened>(self->engine_.router.open(self->request_));
      asio::post(self->socket_.get_executor(), [self, opened] {
        if (!opened->session)
          self->write(std::move(opened->refusal));
        else if (!self->ending_)
          start_websocket(self->engine_, std::move(self->socket_), std::move(self->request_),
                          std::move(opened->session));
      });
    });
    if (!taken) fail(503, "the server is busy; try again");
  }

  /// The peer's request cannot be read any further: say why where there is still somebody to say it to.
  void explain_bad_request(error_code failed) {
    reading_ = false;
    watchdog_.disarm();
    if (failed == http::error::body_limit)
      fail(413, "the request body is over " + std::to_string(engine_.limits.body_bytes) + " bytes");
    else if (failed == http::error::header_limit || failed == http::error::buffer_overflow)
      fail(431, "the request header is over " + std::to_string(engine_.limits.header_bytes) + " bytes");
    else if (failed == http::error::partial_message)
      fail(400, "the request ended before it was whole");
    else if (failed.category() == make_error_code(http::error::bad_target).category() &&
             failed != http::error::end_of_stream)
      fail(400, "not an HTTP/1.1 request: " + failed.message());
    else
      watchdog_.close();
  }

  void fail(int status, const std::string& detail) {
    keep_alive_ = false;
    write(problem(status, detail));
  }

  void write(Response response) {
    reading_ = false;
    keep_alive_ = keep_alive_ && !ending_;
    head_ = response_head(response, security_headers(), keep_alive_);
    const bool with_body = !std::exchange(head_only_, false);
    body_ = with_body ? std::move(response.body) : nullptr;
    file_ = with_body ? std::move(response.file) : std::nullopt;
    leaving_ = {asio::buffer(head_), body_ ? asio::buffer(*body_) : asio::const_buffer()};
    write_some();
  }

  void write_some() {
    if (asio::buffer_size(leaving_) == 0) {
      if (file_ && file_->bytes > 0)
        fetch_piece();
      else
        on_written();
      return;
    }
    watchdog_.arm(engine_.limits.write, shared_from_this());
    socket_.async_write_some(leaving_, [self = shared_from_this()](error_code failed, size_t written) {
      if (failed) {
        self->watchdog_.close();
        return;
      }
      for (asio::const_buffer& buffer : self->leaving_) {
        const size_t of_this = std::min(written, buffer.size());
        buffer += of_this;
        written -= of_this;
      }
      self->write_some();
    });
  }

  /// The disk may take its time: a thread of its own waits for it.
  void fetch_piece() {
    watchdog_.disarm();
    const bool taken = engine_.file_readers.submit([self = shared_from_this()] {
      const bool whole = self->read_piece();
      asio::post(self->socket_.get_executor(), [self, whole] {
        self->leaving_ = {asio::buffer(self->piece_), asio::const_buffer()};
        if (whole)
          self->write_some();
        else
          self->watchdog_.close();
      });
    });
    if (!taken) watchdog_.close();
  }

  /// False when the file is not what it was: what was promised cannot be sent any more.
  bool read_piece() {
    piece_.resize(std::min<uint64_t>(file_->bytes, engine_.limits.file_piece_bytes));
    try {
      if (file_->file->read(file_->offset, piece_) < piece_.size())
        throw Error(ErrorKind::io, "a file became shorter while it was sent");
    } catch (const Error& failure) {
      log::error(failure.what());
      return false;
    }
    file_->offset += piece_.size();
    file_->bytes -= piece_.size();
    return true;
  }

  void on_written() {
    watchdog_.disarm();
    body_.reset();
    file_.reset();
    piece_ = {};
    if (keep_alive_ && !ending_) {
      read_head();
      return;
    }
    error_code ignored;
    socket_.shutdown(tcp::socket::shutdown_send, ignored);
    watchdog_.arm(engine_.limits.linger, shared_from_this());
    drain();
  }

  /// Closing a socket with unread input resets it and can destroy our last words on their way: read on until
  /// the peer closes or the linger time is over.
  void drain() {
    buffer_.clear();
    socket_.async_read_some(buffer_.prepare(65536), [self = shared_from_this()](error_code failed, size_t) {
      if (failed) {
        self->watchdog_.disarm();
        self->watchdog_.close();
      } else {
        self->drain();
      }
    });
  }

  Engine& engine_;
  tcp::socket socket_;
  Watchdog watchdog_;
  beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  Request request_;
  std::string peer_;
  std::string head_;
  SharedBytes body_;
  std::optional<FileStretch> file_;  ///< what of it has not been read yet
  Bytes piece_;
  std::array<asio::const_buffer, 2> leaving_;  ///< of head_ and body_, or of piece_
  bool keep_alive_ = true;
  bool head_only_ = false;
  bool reading_ = false;
  bool ending_ = false;
};

}  // namespace

void start_http(Engine& engine, tcp::socket socket, bool refuse) {
  std::make_shared<HttpConnection>(engine, std::move(socket))->start(refuse);
}

}  // namespace ream::net
