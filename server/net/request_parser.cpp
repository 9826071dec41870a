#include "net/request_parser.hpp"

#include <algorithm>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

#include "core/text.hpp"
#include "net/head_shape.hpp"
#include "net/problem.hpp"

namespace ream::net {
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;
namespace {

constexpr std::string_view head_end = "\r\n\r\n";
constexpr size_t chunk_line_bytes = 4096;  ///< of a chunk's line, and of all trailer lines together

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
  message_ = std::make_unique<Message>();
  auto& parser = message_->parser;
  parser.header_limit(static_cast<uint32_t>(limits_.header_bytes));
  parser.body_limit(limits_.body_bytes);
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
  parser.eager(true);
  waiting_.erase(0, end);
  stage_ = parser.is_done() ? Stage::whole : Stage::body;
}

void RequestParser::read_body() {
  auto& parser = message_->parser;
  error_code failed;
  size_t used = 0;
  while (used < waiting_.size() && !parser.is_done() && !failed)
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
