#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/message.hpp"
#include "net/rate_limiter.hpp"
#include "net/websocket.hpp"
#include "net/worker_pool.hpp"

namespace ream::net {

/// May block: runs on the worker threads, several at once. Errors are thrown (see problem.hpp).
using Handler = std::function<Response(const Request&)>;
/// Opens the session of a WebSocket; throws when there is nothing to open.
using WebSocketHandler = std::function<std::unique_ptr<WebSocketSession>(const Request&)>;

/// What stands before and around the handlers of routes, static files aside. `route`: which one, counted in
/// the order of adding. Called from several worker threads at once.
class RequestPolicy {
 public:
  virtual ~RequestPolicy() = default;
  /// Before every handler, WebSockets included: sets Request::caller, or throws (RequestError 401, 403).
  virtual void authorize(Request& request, size_t route) const = 0;
  /// After that: throws when the request makes no sense to the route; may set Request::json.
  virtual void check(Request& request, size_t route) const = 0;
  /// In place of every handler but those of WebSockets: calls it as `next`, or answers for it.
  virtual Response answer(const Request& request, size_t route, const Handler& next) const = 0;
  /// May put something around a WebSocket that its handler has opened, or refuse it by throwing.
  virtual std::unique_ptr<WebSocketSession> opened(const Request& request, size_t route,
                                                   std::unique_ptr<WebSocketSession> session) const = 0;
};

/// Which handler answers which method and path. Filled once, then only read (from any thread).
/// A pattern is a path whose {name} segments match any one non-empty segment.
class Router {
 public:
  /// What became of a request to open a WebSocket: a session, or the reply that refuses it.
  struct Opened {
    std::unique_ptr<WebSocketSession> session;
    Response refusal;
  };

  /// GET handlers answer HEAD too (the connection drops the body).
  void on(const std::string& method, const std::string& pattern, Handler handler,
          Urgency urgency = Urgency::usual);
  /// A plain GET there is answered 426.
  void on_websocket(const std::string& pattern, WebSocketHandler handler);
  /// Answers GET and HEAD of paths that match no pattern (static files).
  void otherwise(Handler handler);

  /// From here on every request of a route is under this policy, which outlives the router.
  void follow(const RequestPolicy& policy) { policy_ = &policy; }
  /// From here on 429 for a caller, known to the policy by user or credential, whose requests come faster.
  void pace_callers(Rate rate);

  /// Never throws: failures become problem+json; 404 for an unknown path, 405 with Allow for a wrong method.
  Response respond(Request request) const;
  /// How long the request may have to wait for others.
  Urgency urgency_of(const Request& request) const;
  Opened open(Request request) const;

 private:
  struct Entry {
    std::string method;
    std::vector<std::string> segments;
    Handler handler;
    WebSocketHandler websocket_handler;
    Urgency urgency = Urgency::usual;
  };
  Response dispatch(Request& request) const;
  /// The reply that refuses the request, if it is refused; or throws.
  std::optional<Response> admit(Request& request, size_t route) const;

  std::vector<Entry> entries_;
  Handler otherwise_;
  const RequestPolicy* policy_ = nullptr;  ///< null: everything may pass
  std::shared_ptr<RateLimiter> callers_;
};

}  // namespace ream::net
