#include "api/authorizer.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "access/secret.hpp"
#include "api/login_cookie.hpp"
#include "api/visibility.hpp"
#include "net/guard.hpp"
#include "net/problem.hpp"

namespace ream::api {
namespace {

const std::string one_session = "/api/v1/sessions/{id}";

/// Whether a route of one session says what it measured, so that it tells how the bone was made.
bool shows_results(const Route& route) {
  static constexpr std::array parts = {"recording", "session.json", "trace",        "mesh",
                                       "snapshot",  "exports",      "replay",       "metrics",
                                       "score",     "deviation",    "score/preview"};
  const std::string_view pattern = route.pattern;
  return std::any_of(parts.begin(), parts.end(), [&](std::string_view part) {
    return pattern.size() > one_session.size() && pattern.substr(one_session.size() + 1) == part;
  });
}

net::Caller everybody() { return {"", "", "operator", "", ""}; }

net::Caller caller_of(const access::Identity& identity) {
  return {identity.user_id, identity.display_name, access::to_text(identity.role), identity.only_session,
          identity.credential};
}

bool reads_only(const net::Request& request) { return request.method == "GET" || request.method == "HEAD"; }

/// Sent by this machine itself, and not passed on by a proxy that runs on it.
bool is_own_machine(const net::Request& request) {
  constexpr std::string_view mapped = "::ffff:";
  std::string_view peer = request.peer;
  if (peer.starts_with(mapped)) peer.remove_prefix(mapped.size());
  return net::is_loopback_host(peer) && !request.passed_on;
}

bool is_gauge_reader(const Visitor& visitor, const net::Request& request) {
  return is_own_machine(request) ||
         (visitor.identity && visitor.identity->kind == access::CredentialKind::token);
}

void require_access(const Route& route, const Visitor& visitor, const net::Request& request) {
  if (route.access.roles & access::role_bit(visitor.caller.role)) return;
  if (route.access.kind == RouteAccess::Kind::monitoring && is_gauge_reader(visitor, request)) return;
  if (!visitor.identity) refuse_unknown("log in first, or send a token");
  throw net::RequestError(403, visitor.caller.role + "s may not " + request.method + " " + route.pattern);
}

}  // namespace

void require_no_forgery(const Visitor& visitor, const net::Request& request) {
  if (visitor.csrf_token.empty()) return;
  if (!request.header("upgrade").empty() && request.header("origin").empty())
    throw net::RequestError(403, "a WebSocket that is opened by a cookie must say its Origin");
  if (reads_only(request)) return;
  if (!access::equal_in_constant_time(request.header("x-csrf-token"), visitor.csrf_token))
    throw net::RequestError(
        403, "a change by cookie needs the header X-CSRF-Token with what GET /api/v1/login says");
}

Visitor Authorizer::visitor(const net::Request& request) const {
  Visitor visitor;
  if (is_open()) {
    visitor.caller = everybody();
    return visitor;
  }
  if (const access::Secret token = bearer_token_of(request); !token.empty()) {
    visitor.identity = access_control_.credentials.identify(token, access::CredentialKind::token);
    if (!visitor.identity) refuse_unknown("the token is unknown, has ended or was revoked", "invalid_token");
  } else if (const access::Secret cookie = cookie_of(request); !cookie.empty()) {
    visitor.identity = access_control_.credentials.identify(cookie, access::CredentialKind::cookie);
    if (visitor.identity) visitor.csrf_token = access::csrf_token_of(cookie);
  }
  if (visitor.identity) visitor.caller = caller_of(*visitor.identity);
  return visitor;
}

void Authorizer::require_sight(const net::Request& request, const Route& route) const {
  if (!route.pattern.starts_with(one_session)) return;
  const std::string& id = request.parameters.at("id");
  // Only staff rates; whoever of them stands beside a device may stop it.
  if (access::is_staff(request.caller.role)) {
    if (route.urgency != net::Urgency::halt) require_unrated(request.caller, id);
  } else if (const auto session = sessions_.session_of(id); session && !may_see(request.caller, *session)) {
    refuse_unseen(id);
  }
  if (shows_results(route) || sessions_.is_replay(id)) require_shown(request.caller, id);
}

void Authorizer::require_shown(const net::Caller& caller, const std::string& session) const {
  if (sessions_.hides_results(caller, session))
    throw net::RequestError(403, "session '" + session +
                                     "' is of a study of feel; what it measured stays hidden until the study "
                                     "is closed");
}

void Authorizer::require_results(const net::Caller& caller, const std::string& session) const {
  require_unrated(caller, session);
  require_shown(caller, session);
}

void Authorizer::require_unrated(const net::Caller& caller, const std::string& session) const {
  if (sessions_.is_rated_by(caller, session))
    throw net::RequestError(403, "you rate session '" + session +
                                     "'; until its study is closed you see it in your rating queue only");
}

void Authorizer::authorize(net::Request& request, const Route& route) const {
  if (route.access.kind == RouteAccess::Kind::anybody) return;
  const Visitor visitor = this->visitor(request);
  require_no_forgery(visitor, request);
  require_access(route, visitor, request);
  request.caller = visitor.caller;
  for (const char* shown : {"authorization", "cookie", "x-csrf-token"}) request.headers.erase(shown);
  require_sight(request, route);
}

}  // namespace ream::api
