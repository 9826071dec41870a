#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "net/limits.hpp"
#include "net/message.hpp"

namespace ream::net {

/// Reads HTTP/1.1 requests off a stream of bytes, one after another, however the bytes are cut. What has come
/// of the next request already is kept for it.
class RequestParser {
 public:
  /// How much of the request is there. With `body` its head is known and its body is still on its way.
  enum class Stage { nothing, head, body, whole };

  /// `limits` must outlive the parser.
  explicit RequestParser(const Limits& limits);
  ~RequestParser();

  /// Takes more bytes. Throws RequestError 400, 413, 414 or 431 for what cannot be a request; then nothing
  /// that follows can be read either.
  void feed(std::string_view bytes);

  Stage stage() const { return stage_; }

  /// From stage body on: method, path, query and headers.
  Request& request() { return request_; }
  bool keep_alive() const { return keep_alive_; }
  /// Whether the peer waits for "100 Continue" before it sends the body.
  bool wants_continue() const { return wants_continue_; }
  /// Of the body as announced; none for a chunked one.
  std::optional<uint64_t> announced_bytes() const { return announced_bytes_; }

  /// At stage whole.
  std::string take_body();

  /// Goes on to the next request, as far as it is there; throws as feed does.
  void next();

 private:
  struct Message;
  void advance();
  void read_head(size_t end);
  void read_body();

  const Limits& limits_;
  std::string waiting_;  ///< bytes not yet used
  size_t searched_ = 0;  ///< of them, for the end of the head
  Stage stage_ = Stage::nothing;
  std::unique_ptr<Message> message_;
  Request request_;
  bool keep_alive_ = false, wants_continue_ = false;
  std::optional<uint64_t> announced_bytes_;
};

}  // namespace ream::net
