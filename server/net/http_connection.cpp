#include <algorithm>
#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "core/log.hpp"
#include "net/engine.hpp"
#include "net/file_body.hpp"
#include "net/guard.hpp"
#include "net/message.hpp"
#include "net/problem.hpp"
#include "net/request_parser.hpp"
#include "net/transfer_pace.hpp"
#include "net/watchdog.hpp"

namespace ream::net {
namespace asio = boost::asio;
using boost::system::error_code;
namespace {

constexpr unsigned char tls_handshake_byte = 0x16;  ///< RFC 8446, 5.1: what a TLS connection begins with
constexpr size_t body_read_bytes = 64 * 1024;

/// Sends one reply after another over a connection's channel: the head, then bytes of memory, or those of a
/// file piece by piece. A peer that does not take them is cut. Runs on the channel's strand.
class ReplyWriter {
 public:
  ReplyWriter(Engine& engine, Channel& channel, Watchdog& watchdog)
      : engine_(engine), channel_(channel), watchdog_(watchdog) {}

  struct Reply {
    std::weak_ptr<void> owner;  ///< holds writer, channel and watchdog; is kept alive on the way
    std::string head;
    SharedBytes body;
    std::optional<FileStretch> file;
    std::function<void()> done;  ///< called when all has left, not at all when it could not
  };
  void send(Reply reply);

 private:
  void write_some();
  void fetch_piece();
  bool read_piece();
  void finish();

  Engine& engine_;
  Channel& channel_;
  Watchdog& watchdog_;
  Reply reply_;  ///< its file is what has not been read yet
  Bytes piece_;
  std::array<boost::asio::const_buffer, 2> outgoing_;  ///< of head and body, or of piece_
  TransferPace pace_;
};

void ReplyWriter::send(Reply reply) {
  reply_ = std::move(reply);
  outgoing_ = {asio::buffer(reply_.head), reply_.body ? asio::buffer(*reply_.body) : asio::const_buffer()};
  const Limits& limits = engine_.limits;
  pace_ = TransferPace(TransferPace::Clock::now(), limits.write, limits.write, limits.min_bytes_per_s);
  write_some();
}

void ReplyWriter::write_some() {
  if (asio::buffer_size(outgoing_) == 0) {
    if (reply_.file && reply_.file->bytes > 0)
      fetch_piece();
    else
      finish();
    return;
  }
  const auto owner = reply_.owner.lock();
  watchdog_.arm(pace_.time_left(TransferPace::Clock::now()), owner);
  channel_.async_write_some(outgoing_, [this, owner](error_code failed, size_t written) {
    if (failed) {
      watchdog_.close();
      return;
    }
    pace_.moved(written);
    for (asio::const_buffer& buffer : outgoing_) {
      const size_t of_this = std::min(written, buffer.size());
      buffer += of_this;
      written -= of_this;
    }
    write_some();
  });
}

/// The disk may take its time: a thread of its own waits for it.
void ReplyWriter::fetch_piece() {
  watchdog_.disarm();
  const auto taken = engine_.file_readers.submit([this, owner = reply_.owner.lock()] {
    const bool whole = read_piece();
    asio::post(channel_.get_executor(), [this, owner, whole] {
      outgoing_ = {asio::buffer(piece_), asio::const_buffer()};
      if (whole)
        write_some();
      else
        watchdog_.close();
    });
  });
  if (taken != WorkerPool::Taken::yes) watchdog_.close();
}

/// False when the file is not what it was: what was promised cannot be sent any more.
bool ReplyWriter::read_piece() {
  FileStretch& stretch = *reply_.file;
  try {
    piece_.resize(std::min<uint64_t>(stretch.bytes, engine_.limits.file_piece_bytes));
    if (stretch.file->read(stretch.offset, piece_) < piece_.size())
      throw Error(ErrorKind::io, "a file became shorter while it was sent");
  } catch (...) {
    log::current_exception("a file could not be sent whole");
    return false;
  }
  stretch.offset += piece_.size();
  stretch.bytes -= piece_.size();
  return true;
}

void ReplyWriter::finish() {
  watchdog_.disarm();
  piece_ = {};
  const auto done = std::exchange(reply_, {}).done;
  done();
}

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
        parser_(engine.limits) {
    encrypted_ = engine.tls != nullptr;
  }
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
  void fail_plain() {
    encrypted_ = false;
    fail(400, "this port speaks TLS only: ask for it with https:// or wss://");
  }

  void await_handshake() {
    set_wait(Wait::head);
    watchdog_.arm(engine_.limits.header, shared_from_this());
    channel_.async_read_some(asio::buffer(received_), [self = shared_from_this()](error_code failed,
                                                                                  size_t bytes) {
      if (failed)
        self->watchdog_.close();
      else if (static_cast<unsigned char>(self->received_.front()) != tls_handshake_byte)
        self->fail_plain();
      else if (!self->address().empty() &&
               self->engine_.address_rate.take(self->address(), self->engine_.limits.handshake_cost) > 0.0)
        self->watchdog_.close();
      else
        self->start_tls(bytes);
    });
  }

  void start_tls(size_t bytes) {
    channel_.async_encrypt(*engine_.tls->current(), asio::buffer(received_, bytes),
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
      read(asio::buffer(received_));
    } else {
      set_wait(Wait::head);
      watchdog_.arm(engine_.limits.header, shared_from_this());
      advance();
    }
  }

  void read(asio::mutable_buffer into) {
    channel_.async_read_some(into, [self = shared_from_this(), into](error_code failed, size_t bytes) {
      if (failed)
        self->on_end(failed);
      else
        self->on_received({static_cast<const char*>(into.data()), bytes});
    });
  }

  void on_received(std::string_view bytes) {
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
    advance();
  }

  /// As far as the request has come.
  void advance() {
    const RequestParser::Stage stage = parser_.stage();
    if (stage >= RequestParser::Stage::body && wait() == Wait::head) {
      set_wait(Wait::body);
      if (on_head()) advance();
    } else if (stage == RequestParser::Stage::whole) {
      answer();
    } else if (stage == RequestParser::Stage::body) {
      watchdog_.arm(pace_.time_left(TransferPace::Clock::now()), shared_from_this());
      body_piece_.resize(body_read_bytes);
      read(asio::buffer(body_piece_));
    } else {
      read(asio::buffer(received_));
    }
  }

  /// False when the request goes no further, or not from here.
  bool on_head() {
    Request& request = parser_.request();
    keep_alive_ = parser_.keep_alive();
    head_only_ = request.method == "HEAD";
    try {
      engine_.proxies.resolve(request, ends_.peer, channel_.encrypted());
    } catch (const RequestError& error) {
      fail(error.status(), error.what());
      return false;
    }
    encrypted_ = request.encrypted;
    const Limits& limits = engine_.limits;
    pace_ = TransferPace(TransferPace::Clock::now(), limits.body, limits.body, limits.min_bytes_per_s);
    const bool is_websocket = wants_websocket(request);
    if (auto refusal = refuse_foreign(request, is_websocket, {engine_.public_names, ends_.local})) {
      refuse(std::move(*refusal));
    } else if (const double wait_s = engine_.address_rate.take(limit_key(request.peer)); wait_s > 0.0) {
      refuse(too_many_requests("too many requests from " + request.peer + "; wait and send fewer", wait_s));
    } else if (!lend_body(parser_.announced_bytes().value_or(limits.body_bytes))) {
      fail(503, "the server has too many request bodies to hold; try again");
    } else if (is_websocket) {
      open_websocket();
    } else if (parser_.wants_continue() && parser_.stage() == RequestParser::Stage::body) {
      send_continue();
    } else {
      return true;
    }
    return false;
  }

  bool lend_body(size_t bytes) {
    if (bytes > engine_.limits.small_body_bytes) body_lease_ = engine_.bodies.lend(bytes);
    return bytes <= engine_.limits.small_body_bytes || body_lease_;
  }

  void send_continue() {
    static constexpr std::string_view line = "HTTP/1.1 100 Continue\r\n\r\n";
    asio::async_write(channel_, asio::buffer(line), [self = shared_from_this()](error_code failed, size_t) {
      if (failed)
        self->watchdog_.close();
      else
        self->advance();
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
    const Urgency urgency = engine_.router.urgency_of(request);
    const std::string caller = caller_of(request);
    have_done(
        [self = shared_from_this(), request = std::move(request)]() mutable {
          Response response = self->engine_.router.respond(std::move(request));
          asio::post(self->channel_.get_executor(),
                     [self, response = std::move(response)]() mutable { self->write(std::move(response)); });
        },
        urgency, caller);
  }

  /// Whoever shows the same credentials from the same address; who they are is not known yet.
  std::string caller_of(const Request& request) const {
    std::string caller = address();
    for (const char* name : {"authorization", "cookie"}) caller.append("\n").append(request.header(name));
    return caller;
  }

  /// By a worker.
  void have_done(std::function<void()> job, Urgency urgency, const std::string& caller) {
    switch (engine_.workers.submit(std::move(job), urgency, caller)) {
      case WorkerPool::Taken::yes: return;
      case WorkerPool::Taken::full: fail(503, "the server is busy; try again"); return;
      case WorkerPool::Taken::caller_full:
        refuse(too_many_requests("too many of your requests wait for an answer; wait for some", 1.0));
    }
  }

  void open_websocket() {
    stop_waiting();
    const auto open = [self = shared_from_this()] {
      auto opened = std::make_shared<Router::Opened>(self->engine_.router.open(self->parser_.request()));
      asio::post(self->channel_.get_executor(), [self, opened] {
        if (!opened->session)
          self->write(std::move(opened->refusal));
        else if (!self->ending_)
          start_websocket(self->engine_, std::move(self->channel_), self->ends_,
                          std::move(self->parser_.request()), std::move(opened->session));
      });
    };
    have_done(open, Urgency::usual, caller_of(parser_.request()));
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
    writer_.send({weak_from_this(), response_head(response, security_headers(encrypted_), keep_alive_),
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

  void end() { watchdog_.close_lingering(engine_.limits.linger, shared_from_this()); }

  Engine& engine_;
  const Ends ends_;
  Channel channel_;
  Watchdog watchdog_;
  ReplyWriter writer_;
  RequestParser parser_;
  std::array<char, 2048> received_;
  std::vector<char> body_piece_;
  ByteBudget::Lease body_lease_;
  TransferPace pace_;
  bool keep_alive_ = false;
  bool head_only_ = false;
  bool encrypted_ = false;  ///< as far as the client of the last request is concerned
  bool ending_ = false;
};

}  // namespace

void start_http(Engine& engine, Channel::Socket socket, Ends ends, bool refuse) {
  std::make_shared<HttpConnection>(engine, std::move(socket), std::move(ends))->start(refuse);
}

}  // namespace ream::net
