#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/message.hpp"
#include "net/rate_limiter.hpp"
#include "net/websocket.hpp"

namespace ream::net {

/// May block: runs on the worker threads, several at once. Errors are thrown (see problem.hpp).
using Handler = std::function<Response(const Request&)>;
/// Opens the session of a WebSocket; throws when there is nothing to open.
using WebSocketHandler = std::function<std::unique_ptr<WebSocketSession>(const Request&)>;

/// Decides, before a handler is called, whether this request may pass: sets Request::caller, or throws
/// (RequestError 401, 403, 429). `pattern` is that of the route; empty for static files.
using Gate = std::function<void(Request& request, const std::string& pattern)>;

/// May put something around the session of a WebSocket that is about to open.
using WebSocketWrapper =
    std::function<std::unique_ptr<WebSocketSession>(const Request&, std::unique_ptr<WebSocketSession>)>;
/// Looks at a request that may pass; throws when it makes no sense to the route with that pattern.
using Check = std::function<void(const Request& request, const std::string& pattern)>;

/// Called in place of every handler but that of static files, which it calls as `next` or answers for.
using Around =
    std::function<Response(const Request& request, const std::string& pattern, const Handler& next)>;

/// Which handler answers which method and path. Filled once, then only read (from any thread).
/// A pattern is a path whose {name} segments match any one non-empty segment.
class Router {
 public:
  struct Route {
    std::string method, pattern;
  };
  /// What became of a request to open a WebSocket: a session, or the reply that refuses it.
  struct Opened {
    std::unique_ptr<WebSocketSession> session;
    Response refusal;
  };

  /// GET handlers answer HEAD too (the connection drops the body).
  void on(const std::string& method, const std::string& pattern, Handler handler);
  /// A plain GET there is answered 426.
  void on_websocket(const std::string& pattern, WebSocketHandler handler);
  /// Answers GET and HEAD of paths that match no pattern (static files).
  void otherwise(Handler handler);

  /// Asked before every handler, WebSockets and static files included. Without one everything may pass.
  void guard(Gate gate);
  /// Put around every WebSocket, after its handler has opened it.
  void wrap_websockets(WebSocketWrapper wrapper);

  /// From here on 429 for a caller, known to the gate by user or credential, whose requests come faster.
  void pace_callers(Rate rate);

  /// Called after the gate and before every handler of a route, WebSockets included; throws to refuse.
  void check(Check check);
  /// Put around every handler of a route; not around WebSockets and static files.
  void around(Around around);

  /// Never throws: failures become problem+json; 404 for an unknown path, 405 with Allow for a wrong method.
  Response respond(Request request) const;
  Opened open(Request request) const;

  /// Every route in order of adding; WebSockets as GET.
  std::vector<Route> routes() const;

 private:
  struct Entry {
    std::string method, pattern;
    std::vector<std::string> segments;
    Handler handler;
    WebSocketHandler websocket_handler;
  };
  Response dispatch(Request& request) const;
  /// The reply that refuses the request, if it is refused; or throws.
  std::optional<Response> admit(Request& request, const std::string& pattern) const;

  std::vector<Entry> entries_;
  Handler otherwise_;
  Gate gate_;
  std::shared_ptr<RateLimiter> callers_;
  WebSocketWrapper wrapper_;
  Check check_;
  Around around_;
};

}  // namespace ream::net
