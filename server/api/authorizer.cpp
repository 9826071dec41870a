#include "api/authorizer.hpp"

#include "access/secret.hpp"
#include "api/login_cookie.hpp"
#include "api/visibility.hpp"
#include "core/log.hpp"
#include "net/guard.hpp"
#include "net/problem.hpp"

namespace ream::api {
namespace {

const std::string one_session = "/api/v1/sessions/{id}";

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
  return net::is_loopback_host(peer) && request.header("forwarded").empty() &&
         request.header("x-forwarded-for").empty();
}

bool is_gauge_reader(const Visitor& visitor, const net::Request& request) {
  return is_own_machine(request) ||
         (visitor.identity && visitor.identity->kind == access::CredentialKind::token);
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

bool Authorizer::is_open() const { return !gatehouse_ || !gatehouse_->users.any(); }

Visitor Authorizer::visitor(const net::Request& request) const {
  Visitor visitor;
  if (is_open()) {
    visitor.caller = everybody();
    return visitor;
  }
  if (const access::Secret token = bearer_token_of(request); !token.empty()) {
    visitor.identity = gatehouse_->credentials.identify(token, access::CredentialKind::token);
    if (!visitor.identity) refuse_unknown("the token is unknown, has ended or was revoked", "invalid_token");
  } else if (const access::Secret cookie = cookie_of(request); !cookie.empty()) {
    visitor.identity = gatehouse_->credentials.identify(cookie, access::CredentialKind::cookie);
    if (visitor.identity) visitor.csrf_token = access::csrf_token_of(cookie);
  }
  if (visitor.identity) visitor.caller = caller_of(*visitor.identity);
  return visitor;
}

void Authorizer::require_right(const Right& right, const Visitor& visitor,
                               const net::Request& request) const {
  if (right.who & access::role_bit(visitor.caller.role)) return;
  if (right.route_access == RouteAccess::monitoring && is_gauge_reader(visitor, request)) return;
  if (!visitor.identity) refuse_unknown("log in first, or send a token");
  throw net::RequestError(403, visitor.caller.role + "s may not " + request.method + " " + right.pattern);
}

void Authorizer::require_sight(const net::Request& request, const std::string& pattern) const {
  if (!pattern.starts_with(one_session) || !find_session_) return;
  if (access::role_bit(request.caller.role) & access::staff) return;
  const std::string& id = request.parameters.at("id");
  const auto session = find_session_(id);
  if (session && !may_see(request.caller, *session)) refuse_unseen(id);
}

void Authorizer::authorize(net::Request& request, const std::string& pattern) const {
  if (pattern.empty()) return;
  const Right* right = right_of(request.method, pattern);
  if (!right) {
    log::error("nobody may use " + request.method + " " + pattern + ": it is not in the table of rights");
    throw net::RequestError(403, "nobody may " + request.method + " " + pattern);
  }
  if (right->route_access == RouteAccess::anybody) return;
  const Visitor visitor = this->visitor(request);
  require_no_forgery(visitor, request);
  require_right(*right, visitor, request);
  request.caller = visitor.caller;
  for (const char* shown : {"authorization", "cookie", "x-csrf-token"}) request.headers.erase(shown);
  require_sight(request, pattern);
}

}  // namespace ream::api
