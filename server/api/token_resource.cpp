#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::api {
using access::CredentialKind;
using access::Role;
using nlohmann::json;
namespace {

json token_json(const store::CredentialRow& row) {
  return {{"id", row.id},
          {"name", row.name},
          {"user_id", row.user_id},
          {"role", or_null(row.role)},
          {"created_utc", row.created_utc},
          {"expires_utc", row.expires_utc},
          {"last_used_utc", or_null(row.last_used_utc)}};
}

/// Operators have all, or with ?user_id= one user's; others their own.
net::Response list_tokens(const Services& services, const net::Request& request) {
  std::string user_id = query_text(request, "user_id");
  if (request.caller.role != "operator") user_id = request.caller.user_id;
  json tokens = json::array();
  if (user_id.empty() || is_name(user_id))
    for (const auto& row : services.access_control.credentials.list(CredentialKind::token, user_id))
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

net::Response add_token(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  access::NewCredential wanted;
  wanted.name = body.at("name");
  wanted.limit = access::role_from(text_in(body, "role"));
  wanted.expires_utc = text_in(body, "expires_utc");
  const auto maker = services.access_control.credentials.identify_again(request.caller.credential);
  if (!maker || maker->user_id.empty())
    throw Error(ErrorKind::conflict, "a token belongs to a user; add one and log in first");
  wanted.user_id = maker->user_id;
  limit_by_maker(*maker, wanted);
  const access::IssuedCredential issued =
      services.access_control.credentials.issue(CredentialKind::token, wanted);
  services.audit(request, "token.add", issued.row.id, issued.row.name);
  json view = token_json(issued.row);
  view["secret"] = issued.secret.reveal();
  return net::json_response(201, view);
}

net::Response revoke_token(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const auto row = services.access_control.credentials.find(id, CredentialKind::token);
  const bool own = row && !row->user_id.empty() && row->user_id == request.caller.user_id;
  if (!row || (!own && request.caller.role != "operator"))
    throw Error(ErrorKind::not_found, "no token '" + id + "'");
  services.access_control.credentials.revoke(id);
  services.audit(request, "token.revoke", id, row->name);
  return no_content();
}

}  // namespace

std::vector<Route> token_routes() {
  const std::string tokens = "/api/v1/tokens";
  return {{"GET", tokens, access::reamers, not_audited, list_tokens},
          {"POST", tokens, access::reamers, audited_by_handler, add_token},
          {"DELETE", tokens + "/{id}", access::reamers, audited_by_handler, revoke_token}};
}

}  // namespace ream::api
