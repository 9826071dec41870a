#include <nlohmann/json.hpp>

#include "api/json_page.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/error.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

void publish_session(const Services& services, const session::SessionRecord& record, const char* change) {
  services.feed.publish({"session", record.request.id, change,
                         std::make_shared<const session::SessionRequest>(record.request)});
}

net::Response remove_session(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  if (services.replays.has(id))
    throw Error(ErrorKind::conflict, "'" + id + "' is a replay; POST stop ends it");
  if (request.caller.role == "trainee" && !services.sessions.get(id).request.study.empty())
    throw net::RequestError(403, "a session of a study is deleted by those who run the study");
  const session::SessionRecord record = services.sessions.remove(id);
  services.replays.stop_all_of(id);
  publish_session(services, record, "deleted");
  services.retention.was_deleted();
  return no_content();
}

json deleted_json(const Services& services, const study::Blinding& blinding,
                  session::DeletedSession deleted) {
  json session;
  if (deleted.record) {
    deleted.record = blinding.seen(std::move(*deleted.record));
    session = to_json(*deleted.record);
  }
  return {{"id", deleted.id},
          {"deleted_utc", deleted.deleted_utc},
          {"ends_utc", services.retention.ends_utc(deleted.deleted_utc)},
          {"session", std::move(session)}};
}

net::Response restore_session(const Services& services, const net::Request& request) {
  const session::SessionRecord record = services.sessions.restore(id_of(request));
  publish_session(services, record, "restored");
  return net::json_response(200, to_json(services.seen(request.caller, record)));
}

net::Response list_trash(const Services& services, const net::Request& request) {
  const study::Blinding blinding = services.studies.blinding(request.caller);
  std::vector<json> items;
  for (session::DeletedSession& deleted : services.sessions.deleted())
    items.push_back(deleted_json(services, blinding, std::move(deleted)));
  return page_of(request, "deleted", std::move(items), "-deleted_utc");
}

}  // namespace

std::vector<Route> session_trash_routes() {
  const std::string one = "/api/v1/sessions/{id}";
  return {{"DELETE", one, access::reamers, changes("session.delete"), remove_session},
          {"POST", one + "/restore", access::staff, changes("session.restore"), restore_session},
          {"GET", "/api/v1/trash", access::staff, not_audited, list_trash}};
}

}  // namespace ream::api
