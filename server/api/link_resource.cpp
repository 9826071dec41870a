#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::api {
using access::CredentialKind;
using nlohmann::json;
namespace {

json link_json(const store::CredentialRow& row) {
  return {{"id", row.id},
          {"name", row.name},
          {"session", or_null(row.session_id)},
          {"user_id", or_null(row.user_id)},
          {"created_utc", row.created_utc},
          {"expires_utc", row.expires_utc},
          {"last_used_utc", or_null(row.last_used_utc)}};
}

/// Whose links the caller has to do with; empty: everybody's.
std::string maker_for(const net::Caller& caller) { return caller.role == "operator" ? "" : caller.user_id; }

net::Response list_links(const Services& services, const net::Request& request) {
  json links = json::array();
  for (const auto& row :
       services.access_control.credentials.list(CredentialKind::link, maker_for(request.caller)))
    links.push_back(link_json(row));
  return net::json_response(200, {{"links", std::move(links)}});
}

net::Response add_link(const Services& services, const net::Request& request) {
  if (services.authorizer.is_open())
    throw Error(ErrorKind::conflict,
                "without users everybody may watch without a link; add a user first, then make links");
  if (!services.studies.rated_by(request.caller).empty())
    throw Error(
        ErrorKind::conflict,
        "you rate an open study, and a link shows what is hidden from you; make it when the study is closed");
  const json& body = body_of(request);
  access::NewCredential wanted;
  wanted.name = text_in(body, "name");
  wanted.only_session = text_in(body, "session");
  wanted.expires_utc = text_in(body, "expires_utc");
  if (!wanted.only_session.empty()) services.sessions.get(wanted.only_session);
  wanted.user_id = request.caller.user_id;
  const access::IssuedCredential issued =
      services.access_control.credentials.issue(CredentialKind::link, wanted);
  services.audit(request, "link.add", issued.row.id,
                 issued.row.session_id.empty() ? "all sessions" : "session " + issued.row.session_id);
  json view = link_json(issued.row);
  view["secret"] = issued.secret.reveal();
  return net::json_response(201, view);
}

net::Response revoke_link(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const auto row = services.access_control.credentials.find(id, CredentialKind::link);
  const std::string maker = maker_for(request.caller);
  if (!row || (!maker.empty() && row->user_id != maker))
    throw Error(ErrorKind::not_found, "no link '" + id + "'");
  services.access_control.credentials.revoke(id);
  services.audit(request, "link.revoke", id, row->name);
  return no_content();
}

}  // namespace

std::vector<Route> link_routes() {
  const std::string links = "/api/v1/links";
  return {{"GET", links, access::staff, not_audited, list_links},
          {"POST", links, access::staff, audited_by_handler, add_link},
          {"DELETE", links + "/{id}", access::staff, audited_by_handler, revoke_link}};
}

}  // namespace ream::api
