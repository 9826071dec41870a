#include <nlohmann/json.hpp>

#include "api/access_resource.hpp"
#include "api/request_body.hpp"
#include "core/error.hpp"

namespace ream::api {
using access::CredentialKind;
using access::Role;
using nlohmann::json;
namespace {

constexpr size_t max_token_name = 100, max_token_moment = 40;
const std::string path = "/api/v1/tokens";

json token_json(const store::CredentialRow& row) {
  return {{"id", row.id},
          {"name", row.name},
          {"user_id", row.user_id},
          {"role", row.role.empty() ? json(nullptr) : json(row.role)},
          {"created_utc", row.created_utc},
          {"expires_utc", row.expires_utc},
          {"last_used_utc", row.last_used_utc.empty() ? json(nullptr) : json(row.last_used_utc)}};
}

/// Operators have all, or with ?user_id= one user's; others their own.
net::Response list(const AccessTools& tools, const net::Request& request) {
  const auto wanted = request.query.find("user_id");
  std::string user_id = wanted == request.query.end() ? "" : wanted->second;
  if (request.caller.role != "operator") user_id = request.caller.user_id;
  json tokens = json::array();
  if (tools.gatehouse && (user_id.empty() || is_name(user_id)))
    for (const auto& row : tools.gatehouse->credentials.list(CredentialKind::token, user_id))
      tokens.push_back(token_json(row));
  return net::json_response(200, {{"tokens", std::move(tokens)}});
}

/// Nobody gets more, or for longer, by making a token than they have already.
void limit_by_maker(const access::Identity& maker, access::NewCredential& wanted) {
  if (wanted.limit && !access::may_be_limited(maker.role, *wanted.limit))
    throw net::RequestError(422,
                            "a token may not do more than who makes it (" + access::to_text(maker.role) + ")",
                            {{"#/role", "is not within the maker's"}});
  if (!wanted.expires_utc.empty()) utc_moment(wanted.expires_utc);
  if (maker.kind != CredentialKind::token) return;
  if (!wanted.limit) wanted.limit = maker.role;
  if (wanted.expires_utc.empty() || wanted.expires_utc > maker.expires_utc)
    wanted.expires_utc = maker.expires_utc;
}

net::Response add(const AccessTools& tools, const net::Request& request) {
  RequestBody body(request);
  access::NewCredential wanted;
  wanted.name = body.words("name", 1, max_token_name);
  if (const auto role = body.words_or_none("role", max_token_name)) {
    wanted.limit = access::role_from(*role);
    if (!wanted.limit) body.one_of("role", {"operator", "instructor", "trainee", "viewer"});
  }
  wanted.expires_utc = body.words("expires_utc", 0, max_token_moment);
  body.finish();
  access::AccessControl& gatehouse = gatehouse_of(tools);
  const auto maker = gatehouse.credentials.identify_again(request.caller.credential);
  if (!maker || maker->user_id.empty())
    throw Error(ErrorKind::conflict, "a token belongs to a user; add one and log in first");
  if (!access::is_plain_line(wanted.name))
    throw net::RequestError(422, "'name' must be one line", {{"#/name", "must be one line"}});
  wanted.user_id = maker->user_id;
  limit_by_maker(*maker, wanted);
  const access::IssuedCredential issued = gatehouse.credentials.issue(CredentialKind::token, wanted);
  audit_in (&gatehouse)(request, "token.add", issued.row.id, issued.row.name);
  json told = token_json(issued.row);
  told["secret"] = issued.secret.reveal();
  return net::json_response(201, told);
}

net::Response revoke(const AccessTools& tools, const net::Request& request) {
  access::AccessControl& gatehouse = gatehouse_with(tools, "token");
  const std::string& id = id_in(request, "token");
  const auto row = gatehouse.credentials.find(id, CredentialKind::token);
  const bool own = row && !row->user_id.empty() && row->user_id == request.caller.user_id;
  if (!row || (!own && request.caller.role != "operator"))
    throw Error(ErrorKind::not_found, "no token '" + id + "'; GET /api/v1/tokens lists them");
  gatehouse.credentials.revoke(id);
  audit_in (&gatehouse)(request, "token.revoke", id, row->name);
  return {204, {}, nullptr, {}};
}

}  // namespace

void add_token_routes(net::Router& router, const AccessTools& tools) {
  router.on("GET", path, [tools](const net::Request& request) { return list(tools, request); });
  router.on("POST", path, [tools](const net::Request& request) { return add(tools, request); });
  router.on("DELETE", path + "/{id}",
            [tools](const net::Request& request) { return revoke(tools, request); });
}

}  // namespace ream::api
