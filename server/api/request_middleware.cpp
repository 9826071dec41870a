#include "api/request_middleware.hpp"

#include "access/login_backoff.hpp"
#include "api/routes.hpp"
#include "core/log.hpp"
#include "net/conditional.hpp"

namespace ream::api {
namespace {

/// A handler's answer; what was asked too often becomes 429 with Retry-After.
net::Response answered(const net::Handler& handler, const net::Request& request) {
  try {
    return handler(request);
  } catch (const access::TooManyAttempts& busy) {
    throw net::RequestError(429, busy.what(), {}, {{"Retry-After", std::to_string(busy.retry_after_s())}});
  }
}

/// Id of what a request was about: {id}, else of the thing that the reply's Location names; empty without.
std::string object_of(const net::Request& request, const net::Response& response) {
  const auto id = request.parameters.find("id");
  if (id != request.parameters.end()) return id->second;
  const std::string_view made = response.header("Location");
  return std::string(made.substr(made.rfind('/') + 1));
}

}  // namespace

void RequestMiddleware::install(net::Router& router) const {
  for (const Route& route : routes())
    if (const auto* handler = std::get_if<RequestHandler>(&route.handler))
      router.on(
          route.method, route.pattern,
          [this, answer = *handler](const net::Request& request) { return answer(services_, request); },
          route.urgency);
    else
      router.on_websocket(route.pattern,
                          [this, open = std::get<SocketHandler>(route.handler)](const net::Request& request) {
                            return open(services_, request);
                          });
  router.follow(*this);
}

void RequestMiddleware::authorize(net::Request& request, size_t route) const {
  services_.authorizer.authorize(request, routes()[route]);
}

void RequestMiddleware::check(net::Request& request, size_t route) const {
  contract_.check(request, routes()[route].pattern);
}

/// What is only read is noted before it leaves; what is changed is noted when it has been, and only begun
/// where it can be.
net::Response RequestMiddleware::audited(const net::Request& request, const Route& route,
                                         const net::Handler& handler) const {
  using Kind = RouteAudit::Kind;
  const RouteAudit& audit = route.audit;
  const bool kept = audit.kind != Kind::nothing && request.method == route.method;
  if (kept && audit.kind != Kind::reading) services_.access_control.audit.require_writable();
  net::Response response = answered(handler, request);
  if (!kept || !audit.action || response.status < 200 || response.status >= 300) return response;
  if (audit.kind == Kind::reading)
    services_.audit_reading(request, audit.action, object_of(request, response));
  else
    services_.audit(request, audit.action, object_of(request, response), "");
  return response;
}

net::Response RequestMiddleware::answer(const net::Request& request, size_t number,
                                        const net::Handler& next) const {
  const Route& route = routes()[number];
  const net::Handler done = [&](const net::Request& passed) {
    net::Response response = audited(passed, route, next);
    publish_change(passed, route, response);
    return response;
  };
  if (contract_.takes_idempotency_key(request.method, route.pattern))
    return idempotency_.answer(
        request, done, route.names_a_file ? Idempotency::Place::memory : Idempotency::Place::database);
  return net::conditional(request, done(request));
}

std::unique_ptr<net::WebSocketSession> RequestMiddleware::opened(
    const net::Request& request, size_t route, std::unique_ptr<net::WebSocketSession> session) const {
  const RouteAudit& audit = routes()[route].audit;
  if (audit.kind == RouteAudit::Kind::reading)
    services_.audit_reading(request, audit.action, object_of(request, {}));
  return stream_watch_.watched(request, std::move(session));
}

/// The change was made; that it cannot be announced is no reason to say it failed.
void RequestMiddleware::publish_change(const net::Request& request, const Route& route,
                                       const net::Response& response) const {
  try {
    auto change = change_made(request, route, response);
    if (!change) return;
    if (change->kind == "session" || change->kind == "replay")
      if (auto session = sessions_.session_of(request.parameters.at("id")))
        change->session = std::make_shared<const session::SessionRequest>(std::move(*session));
    services_.feed.publish(*change);
  } catch (const std::exception& failure) {
    log::warn(std::string("a change could not be announced: ") + failure.what());
  }
}

std::optional<Change> change_made(const net::Request& request, const Route& route,
                                  const net::Response& response) {
  if (!route.change.kind || response.status >= 300) return std::nullopt;
  const std::string_view made = response.header("Location");
  const std::string id =
      made.empty() ? request.parameters.at("id") : std::string(made.substr(made.rfind('/') + 1));
  return Change{route.change.kind, id, route.change.change};
}

}  // namespace ream::api
