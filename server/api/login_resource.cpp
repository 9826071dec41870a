#include <chrono>

#include "api/login_cookie.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::api {
using access::CredentialKind;
using access::Secret;
using nlohmann::json;
namespace {

Secret secret_in(const net::Request& request, const char* key) {
  return Secret(body_of(request).at(key).get<std::string>());
}

json visitor_json(const Visitor& visitor, bool open) {
  const auto& identity = visitor.identity;
  json user;
  if (identity && !identity->user_id.empty())
    user = {{"id", identity->user_id}, {"name", identity->name}, {"display_name", identity->display_name}};
  return {{"login_needed", !open},
          {"role", or_null(visitor.caller.role)},
          {"user", std::move(user)},
          {"only_session", or_null(visitor.caller.only_session)},
          {"csrf_token", or_null(visitor.csrf_token)},
          {"expires_utc", identity ? json(identity->expires_utc) : json(nullptr)}};
}

net::Response who_am_i(const Services& services, const net::Request& request) {
  return net::json_response(
      200, visitor_json(services.authorizer.visitor(request), services.authorizer.is_open()));
}

/// Gives the page a cookie and tells who it is now.
net::Response let_in(const Services& services, const net::Request& request,
                     const access::NewCredential& wanted, const std::string& action) {
  const access::IssuedCredential cookie =
      services.access_control.credentials.issue(CredentialKind::cookie, wanted);
  net::Request with_cookie = request;
  with_cookie.headers.erase("authorization");
  with_cookie.headers["cookie"] = login_cookie(cookie.secret, {}, request.encrypted);
  const Visitor visitor = services.authorizer.visitor(with_cookie);
  with_cookie.caller = visitor.caller;
  services.audit(with_cookie, action, wanted.user_id, "");
  net::Response response = net::json_response(200, visitor_json(visitor, services.authorizer.is_open()));
  const auto lifetime = utc_moment(cookie.row.expires_utc) - utc_moment(cookie.row.created_utc);
  response.headers.emplace_back(
      "Set-Cookie", login_cookie(cookie.secret, std::chrono::duration_cast<std::chrono::seconds>(lifetime),
                                 request.encrypted));
  return response;
}

net::Response log_in(const Services& services, const net::Request& request) {
  const std::string name = body_of(request).at("name");
  const Secret password = secret_in(request, "password");
  access::LoginOrigin origin{request.peer, device_of(request)};
  if (origin.device.empty()) origin.device = access::make_credential_secret().text;
  const auto user = services.access_control.users.log_in(name, password, origin);
  if (!user) {
    // What was typed may be a password in the wrong field: only names that exist are kept.
    const auto known =
        services.access_control.users.find_by_name(access::is_user_name(lower(name)) ? name : "");
    services.audit(request, "login.failed", known ? known->id : "", known ? known->name : "");
    refuse_unknown("name or password is wrong");
  }
  access::NewCredential wanted;
  wanted.user_id = user->id;
  net::Response response = let_in(services, request, wanted, "login");
  response.headers.emplace(response.headers.begin(), "Set-Cookie",
                           device_cookie(origin.device, request.encrypted));
  return response;
}

net::Response log_in_by_link(const Services& services, const net::Request& request) {
  const auto link =
      services.access_control.credentials.identify(secret_in(request, "secret"), CredentialKind::link);
  if (!link) refuse_unknown("the link is unknown, has ended or was revoked");
  access::NewCredential wanted;
  wanted.name = link->display_name;
  wanted.only_session = link->only_session;
  wanted.parent_id = link->credential;
  wanted.expires_utc = link->expires_utc;
  return let_in(services, request, wanted, "login.link");
}

net::Response log_out(const Services& services, const net::Request& request) {
  net::Response response{204, {}, nullptr, {}};
  response.headers.emplace_back("Set-Cookie", no_login_cookie(request.encrypted));
  const Visitor visitor = services.authorizer.visitor(request);
  if (!visitor.identity) return response;
  if (visitor.identity->kind == CredentialKind::token)
    throw Error(ErrorKind::conflict, "a token is not logged out; revoke it at /api/v1/tokens");
  require_no_forgery(visitor, request);
  net::Request known = request;
  known.caller = visitor.caller;
  services.access_control.credentials.revoke(visitor.identity->credential);
  services.audit(known, "logout", visitor.caller.user_id, "");
  return response;
}

net::Response change_password(const Services& services, const net::Request& request) {
  const net::Caller& caller = request.caller;
  const access::PasswordChange wanted{secret_in(request, "password"), secret_in(request, "new_password"),
                                      caller.credential, body_of(request).value("keep_tokens", false)};
  if (caller.user_id.empty())
    throw Error(ErrorKind::conflict, "nobody is logged in; without users there is no password");
  const access::LoginOrigin origin{request.peer, Secret(std::string_view(caller.credential)), true};
  if (!services.access_control.users.change_password(caller.user_id, wanted, origin))
    throw net::RequestError(422, "the present password is wrong", {{"#/password", "is wrong"}});
  services.audit(request, "password.change", caller.user_id, wanted.keep_tokens ? "tokens stay" : "");
  return no_content();
}

}  // namespace

std::vector<Route> login_routes() {
  const std::string login = "/api/v1/login";
  std::vector<Route> all = {
      {"GET", login, for_anybody, not_audited, who_am_i},
      {"POST", login, for_anybody, audited_by_handler, log_in},
      {"DELETE", login, for_anybody, audited_by_handler, log_out},
      {"POST", login + "/link", for_anybody, audited_by_handler, log_in_by_link},
      {"POST", login + "/password", access::reamers, audited_by_handler, change_password}};
  for (Route& route : all) route.urgency = net::Urgency::entry;
  return all;
}

}  // namespace ream::api
