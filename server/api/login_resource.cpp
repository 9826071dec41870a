#include <chrono>

#include "access/password_hasher.hpp"
#include "api/access_resource.hpp"
#include "api/login_cookie.hpp"
#include "api/request_body.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"

namespace ream::api {
using access::CredentialKind;
using access::Secret;
using nlohmann::json;
namespace {

constexpr size_t max_login_name = 200, longest_secret = access::max_password_bytes;
const std::string login_path = "/api/v1/login";

Secret secret_in(RequestBody& body, const std::string& key) {
  std::string text = body.words(key, 1, longest_secret);
  return Secret(std::move(text));
}

json visitor_json(const Visitor& visitor, bool open) {
  const auto& identity = visitor.identity;
  json user;
  if (identity && !identity->user_id.empty())
    user = {{"id", identity->user_id}, {"name", identity->name}, {"display_name", identity->display_name}};
  const auto or_null = [](const std::string& text) { return text.empty() ? json(nullptr) : json(text); };
  return {{"login_needed", !open},
          {"role", or_null(visitor.caller.role)},
          {"user", std::move(user)},
          {"only_session", or_null(visitor.caller.only_session)},
          {"csrf_token", or_null(visitor.csrf_token)},
          {"expires_utc", identity ? json(identity->expires_utc) : json(nullptr)}};
}

net::Response who_am_i(const AccessTools& tools, const net::Request& request) {
  return net::json_response(200, visitor_json(tools.authorizer.visitor(request), tools.authorizer.is_open()));
}

/// Gives the page a cookie and tells who it is now.
net::Response let_in(const AccessTools& tools, const net::Request& request,
                     const access::NewCredential& wanted, const std::string& action) {
  access::AccessControl& gatehouse = gatehouse_of(tools);
  const access::IssuedCredential cookie = gatehouse.credentials.issue(CredentialKind::cookie, wanted);
  net::Request with_cookie = request;
  with_cookie.headers.erase("authorization");
  with_cookie.headers["cookie"] = login_cookie(cookie.secret, {}, false);
  const Visitor visitor = tools.authorizer.visitor(with_cookie);
  with_cookie.caller = visitor.caller;
  audit_in (&gatehouse)(with_cookie, action, wanted.user_id, "");
  net::Response response = net::json_response(200, visitor_json(visitor, tools.authorizer.is_open()));
  const auto lifetime = utc_moment(cookie.row.expires_utc) - utc_moment(cookie.row.created_utc);
  response.headers.emplace_back(
      "Set-Cookie", login_cookie(cookie.secret, std::chrono::duration_cast<std::chrono::seconds>(lifetime),
                                 request.encrypted));
  return response;
}

net::Response log_in(const AccessTools& tools, const net::Request& request) {
  RequestBody body(request);
  const std::string name = body.words("name", 1, max_login_name);
  const Secret password = secret_in(body, "password");
  body.finish();
  access::AccessControl& gatehouse = gatehouse_of(tools);
  const auto user = gatehouse.users.log_in(name, password, request.peer);
  if (!user) {
    // What was typed may be a password in the wrong field: only names that exist are kept.
    const auto known = gatehouse.users.find_by_name(access::is_user_name(lower(name)) ? name : "");
    audit_in (&gatehouse)(request, "login.failed", known ? known->id : "", known ? known->name : "");
    refuse_unknown("name or password is wrong");
  }
  access::NewCredential wanted;
  wanted.user_id = user->id;
  return let_in(tools, request, wanted, "login");
}

net::Response log_in_by_link(const AccessTools& tools, const net::Request& request) {
  RequestBody body(request);
  const Secret secret = secret_in(body, "secret");
  body.finish();
  access::AccessControl& gatehouse = gatehouse_of(tools);
  const auto link = gatehouse.credentials.identify(secret, CredentialKind::link);
  if (!link) refuse_unknown("the link is unknown, has ended or was revoked");
  access::NewCredential wanted;
  wanted.name = link->display_name;
  wanted.only_session = link->only_session;
  wanted.parent_id = link->credential;
  wanted.expires_utc = link->expires_utc;
  return let_in(tools, request, wanted, "login.link");
}

net::Response log_out(const AccessTools& tools, const net::Request& request) {
  net::Response response{204, {}, nullptr, {}};
  response.headers.emplace_back("Set-Cookie", no_login_cookie(request.encrypted));
  const Visitor visitor = tools.authorizer.visitor(request);
  if (!visitor.identity) return response;
  if (visitor.identity->kind == CredentialKind::token)
    throw Error(ErrorKind::conflict, "a token is not logged out; revoke it at /api/v1/tokens");
  require_no_forgery(visitor, request);
  net::Request known = request;
  known.caller = visitor.caller;
  tools.gatehouse->credentials.revoke(visitor.identity->credential);
  audit_in(tools.gatehouse)(known, "logout", visitor.caller.user_id, "");
  return response;
}

net::Response change_password(const AccessTools& tools, const net::Request& request) {
  RequestBody body(request);
  const Secret present = secret_in(body, "password"), wanted = secret_in(body, "new_password");
  body.finish();
  const net::Caller& caller = request.caller;
  if (caller.user_id.empty())
    throw Error(ErrorKind::conflict, "nobody is logged in; without users there is no password");
  access::AccessControl& gatehouse = gatehouse_of(tools);
  if (!gatehouse.users.change_password(caller.user_id, present, wanted, request.peer, caller.credential))
    throw net::RequestError(422, "the present password is wrong", {{"#/password", "is wrong"}});
  audit_in (&gatehouse)(request, "password.change", caller.user_id, "");
  return {204, {}, nullptr, {}};
}

}  // namespace

void add_login_routes(net::Router& router, const AccessTools& tools) {
  router.on("GET", login_path, [tools](const net::Request& request) { return who_am_i(tools, request); });
  router.on("POST", login_path, [tools](const net::Request& request) {
    return patiently([&] { return log_in(tools, request); });
  });
  router.on("DELETE", login_path, [tools](const net::Request& request) { return log_out(tools, request); });
  router.on("POST", login_path + "/link",
            [tools](const net::Request& request) { return log_in_by_link(tools, request); });
  router.on("POST", login_path + "/password", [tools](const net::Request& request) {
    return patiently([&] { return change_password(tools, request); });
  });
}

}  // namespace ream::api
