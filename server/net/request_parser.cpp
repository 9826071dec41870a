#include "net/request_parser.hpp"

#include <algorithm>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <functional>

#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;
namespace {

constexpr std::string_view line_end = "\r\n", head_end = "\r\n\r\n";
/// The line of the last chunk, "0", and two line ends: the library asserts that it sees as many at once.
constexpr size_t last_chunk_bytes = 5;
constexpr size_t chunk_line_bytes = 4096;  ///< of a chunk's line, and of all trailer lines together

[[noreturn]] void refuse_request(const std::string& what) {
  throw RequestError(400, "not a plain HTTP/1.1 request: " + what);
}

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// The headers that say where a request ends and whom it is for.
struct Framing {
  bool length = false, host = false, coding = false;

  void take(const std::string& name, std::string_view value) {
    if (name == "content-length") {
      if (length) refuse_request("Content-Length comes twice");
      if (value.empty() || value.find_first_not_of("0123456789") != std::string_view::npos)
        refuse_request("Content-Length is no number");
      length = true;
    } else if (name == "transfer-encoding") {
      if (coding) refuse_request("Transfer-Encoding comes twice");
      if (lower(value) != "chunked") refuse_request("the only transfer coding is chunked");
      coding = true;
    } else if (name == "host") {
      if (host) refuse_request("Host comes twice");
      host = true;
    }
    if (length && coding) refuse_request("Content-Length and Transfer-Encoding exclude each other");
  }
};

void take_line(std::string_view line, const Limits& limits, Framing& framing) {
  if (line.size() > limits.header_line_bytes)
    throw RequestError(431, "a header line is over " + std::to_string(limits.header_line_bytes) + " bytes");
  if (line.front() == ' ' || line.front() == '\t') refuse_request("a header goes on in a second line");
  const size_t colon = line.find(':');
  if (colon == std::string_view::npos) refuse_request("a header line has no colon");
  const std::string_view name = line.substr(0, colon);
  if (name.empty() || name.find_first_of(" \t") != std::string_view::npos)
    refuse_request("white space in a header's name");
  framing.take(lower(name), trimmed(line.substr(colon + 1)));
}

/// Of a head that may not have come whole yet: refuses what is too large, stray CR or LF and control
/// characters; those before `from` have been looked at. The first fault counts, however the bytes come.
void require_plain_beginning(std::string_view beginning, size_t from, const Limits& limits) {
  for (size_t i = from; i < std::min(beginning.size(), limits.header_bytes); ++i) {
    const auto c = static_cast<unsigned char>(beginning[i]);
    if (c == '\r') {
      if (i + 1 < beginning.size() && beginning[i + 1] != '\n') refuse_request("a stray CR");
    } else if (c == '\n') {
      if (i == 0 || beginning[i - 1] != '\r') refuse_request("a stray LF");
    } else if ((c < 32 && c != '\t') || c == 127) {
      refuse_request("a control character in its header");
    }
  }
  if (beginning.size() > limits.header_bytes)
    throw RequestError(431, "the request header is over " + std::to_string(limits.header_bytes) + " bytes");
}

/// Refuses a request's head that is too large or that two readers could read differently (request smuggling):
/// stray CR or LF, control characters, continued lines, white space before a colon, two lengths or hosts, a
/// length beside a transfer coding, any coding but "chunked". `head` ends with its empty line.
/// Throws RequestError 400, 414 (request line) or 431.
void require_plain_head(std::string_view head, const Limits& limits) {
  require_plain_beginning(head, 0, limits);
  const size_t first = head.find(line_end);
  if (first > limits.target_bytes)
    throw RequestError(414, "the request line is over " + std::to_string(limits.target_bytes) + " bytes");
  Framing framing;
  size_t lines = 0;
  for (size_t begin = first + 2; begin < head.size();) {
    const size_t end = head.find(line_end, begin);
    if (end == begin) break;
    if (++lines > limits.header_lines)
      throw RequestError(431,
                         "the request has over " + std::to_string(limits.header_lines) + " header lines");
    take_line(head.substr(begin, end - begin), limits, framing);
    begin = end + line_end.size();
  }
}

std::string text(beast::string_view view) { return {view.data(), view.size()}; }

Request request_of(const http::request<http::string_body>& message) {
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

}  // namespace

struct RequestParser::Message {
  explicit Message(const Limits& limits) : body_left(limits.body_bytes) {
    parser.header_limit(static_cast<uint32_t>(limits.header_bytes));
    // The library takes a chunk off its own limit each time it looks at the chunk's line, as often as more of
    // that comes: only a body of an announced length is left to it.
    parser.body_limit(limits.body_bytes);
    parser.on_chunk_header(take_chunk);
  }
  Message(const Message&) = delete;

  uint64_t body_left;  ///< bytes, of a chunked body
  std::function<void(uint64_t, beast::string_view, error_code&)> take_chunk =
      [this](uint64_t bytes, beast::string_view, error_code& failed) {
        if (bytes > body_left) failed = http::error::body_limit;
        body_left -= std::min(bytes, body_left);
      };
  http::request_parser<http::string_body> parser;
};

RequestParser::RequestParser(const Limits& limits) : limits_(limits) {}

RequestParser::~RequestParser() = default;

void RequestParser::feed(std::string_view bytes) {
  waiting_.append(bytes);
  advance();
}

std::string RequestParser::take_body() { return std::move(message_->parser.get().body()); }

void RequestParser::next() {
  message_.reset();
  request_ = {};
  stage_ = Stage::nothing;
  searched_ = 0;
  if (waiting_.empty()) waiting_.shrink_to_fit();
  advance();
}

void RequestParser::advance() {
  if (stage_ == Stage::nothing && !waiting_.empty()) stage_ = Stage::head;
  if (stage_ == Stage::head) {
    const size_t from = searched_ - std::min(searched_, head_end.size());
    const size_t end = waiting_.find(head_end, from);
    searched_ = waiting_.size();
    if (end == std::string::npos)
      require_plain_beginning(waiting_, from, limits_);
    else
      read_head(end + head_end.size());
  }
  if (stage_ == Stage::body) read_body();
}

void RequestParser::read_head(size_t end) {
  const std::string_view head(waiting_.data(), end);
  require_plain_head(head, limits_);
  message_ = std::make_unique<Message>(limits_);
  auto& parser = message_->parser;
  error_code failed;
  const size_t used = parser.put(boost::asio::const_buffer(head.data(), head.size()), failed);
  if (failed == http::error::body_limit)
    throw RequestError(413, "the request body is over " + std::to_string(limits_.body_bytes) + " bytes");
  if (failed || used != head.size() || !parser.is_header_done())
    throw RequestError(400, "not an HTTP/1.1 request: " + failed.message());
  request_ = request_of(parser.get());
  const bool newest = parser.get().version() == 11;
  keep_alive_ = newest && parser.keep_alive();
  if (!newest && parser.chunked()) throw RequestError(400, "HTTP/1.0 has no transfer coding");
  wants_continue_ = newest && lower(std::string(request_.header("expect"))) == "100-continue";
  announced_bytes_ =
      parser.chunked() ? std::nullopt : std::optional<uint64_t>(parser.content_length().value_or(0));
  if (parser.chunked()) parser.body_limit(boost::none);
  parser.eager(true);
  waiting_.erase(0, end);
  stage_ = parser.is_done() ? Stage::whole : Stage::body;
}

void RequestParser::read_body() {
  auto& parser = message_->parser;
  error_code failed;
  size_t used = 0;
  const auto may_end_here = [&] {
    return parser.chunked() && waiting_[used] == '0' && waiting_.size() - used < last_chunk_bytes;
  };
  while (used < waiting_.size() && !may_end_here() && !parser.is_done() && !failed)
    used += parser.put(boost::asio::const_buffer(waiting_.data() + used, waiting_.size() - used), failed);
  waiting_.erase(0, used);
  if (failed == http::error::body_limit)
    throw RequestError(413, "the request body is over " + std::to_string(limits_.body_bytes) + " bytes");
  if (failed && failed != http::error::need_more)
    throw RequestError(400, "the request body is not what its header announces: " + failed.message());
  if (parser.is_done())
    stage_ = Stage::whole;
  else if (waiting_.size() > chunk_line_bytes)
    throw RequestError(400, "a line between the chunks of the request body is over " +
                                std::to_string(chunk_line_bytes) + " bytes");
}

}  // namespace ream::net
