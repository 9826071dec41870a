
#include "api/access_resource.hpp"
#include "api/request_body.hpp"
#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::api {
using access::CredentialKind;
using nlohmann::json;
namespace {

constexpr size_t max_link_name = 100, longest_moment = 40;
const std::string links_path = "/api/v1/links";

json link_json(const store::CredentialRow& row) {
  return {{"id", row.id},
          {"name", row.name},
          {"session", row.session_id.empty() ? json(nullptr) : json(row.session_id)},
          {"user_id", row.user_id.empty() ? json(nullptr) : json(row.user_id)},
          {"created_utc", row.created_utc},
          {"expires_utc", row.expires_utc},
          {"last_used_utc", row.last_used_utc.empty() ? json(nullptr) : json(row.last_used_utc)}};
}

/// Whose links the caller has to do with; empty: everybody's.
std::string maker_for(const net::Caller& caller) { return caller.role == "operator" ? "" : caller.user_id; }

net::Response list(const AccessTools& tools, const net::Request& request) {
  json links = json::array();
  if (tools.gatehouse)
    for (const auto& row : tools.gatehouse->credentials.list(CredentialKind::link, maker_for(request.caller)))
      links.push_back(link_json(row));
  return net::json_response(200, {{"links", std::move(links)}});
}

net::Response add(const AccessTools& tools, const net::Request& request) {
  RequestBody body(request);
  access::NewCredential wanted;
  wanted.name = body.words("name", 0, max_link_name);
  wanted.only_session = body.name_or("session", "");
  wanted.expires_utc = body.words("expires_utc", 0, longest_moment);
  body.finish();
  access::AccessControl& gatehouse = gatehouse_of(tools);
  if (!access::is_plain_line(wanted.name))
    throw net::RequestError(422, "'name' must be one line", {{"#/name", "must be one line"}});
  if (!wanted.only_session.empty()) tools.require_session(wanted.only_session);
  wanted.user_id = request.caller.user_id;
  const access::IssuedCredential issued = gatehouse.credentials.issue(CredentialKind::link, wanted);
  audit_in (&gatehouse)(request, "link.add", issued.row.id,
                        issued.row.session_id.empty() ? "all sessions" : "session " + issued.row.session_id);
  json told = link_json(issued.row);
  told["secret"] = issued.secret.reveal();
  return net::json_response(201, told);
}

net::Response revoke(const AccessTools& tools, const net::Request& request) {
  access::AccessControl& gatehouse = gatehouse_with(tools, "link");
  const std::string& id = id_in(request, "link");
  const auto row = gatehouse.credentials.find(id, CredentialKind::link);
  const std::string maker = maker_for(request.caller);
  if (!row || (!maker.empty() && row->user_id != maker))
    throw Error(ErrorKind::not_found, "no link '" + id + "'; GET /api/v1/links lists them");
  gatehouse.credentials.revoke(id);
  audit_in (&gatehouse)(request, "link.revoke", id, row->name);
  return {204, {}, nullptr, {}};
}

}  // namespace

void add_link_routes(net::Router& router, const AccessTools& tools) {
  router.on("GET", links_path, [tools](const net::Request& request) { return list(tools, request); });
  router.on("POST", links_path, [tools](const net::Request& request) { return add(tools, request); });
  router.on("DELETE", links_path + "/{id}",
            [tools](const net::Request& request) { return revoke(tools, request); });
}

}  // namespace ream::api
