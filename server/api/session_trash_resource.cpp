#include "api/session_trash_resource.hpp"

#include <nlohmann/json.hpp>

#include "api/json_page.hpp"
#include "api/request_body.hpp"
#include "api/session_json.hpp"
#include "core/error.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string trash_path = "/api/v1/sessions";

void tell(const TrashTools& tools, const session::SessionRecord& record, const char* change) {
  tools.feed.tell({"session", record.request.id, change,
                   std::make_shared<const session::SessionRequest>(record.request)});
}

net::Response remove(const TrashTools& tools, const net::Request& request) {
  const std::string& id = id_of(request);
  if (tools.replays.has(id)) throw Error(ErrorKind::conflict, "'" + id + "' is a replay; POST stop ends it");
  if (request.caller.role == "trainee" && !tools.sessions.get(id).request.study.empty())
    throw net::RequestError(403, "a session of a study is deleted by those who run the study");
  const session::SessionRecord record = tools.sessions.remove(id);
  tools.replays.stop_all_of(id);
  tell(tools, record, "deleted");
  tools.retention.was_deleted();
  return {204, {}, nullptr, {}};
}

json deleted_json(const TrashTools& tools, const study::Blinding& blinding, session::DeletedSession deleted) {
  json session;
  if (deleted.record) {
    deleted.record->request = blinding.seen(std::move(deleted.record->request));
    session = api::to_json(*deleted.record);
  }
  return {{"id", deleted.id},
          {"deleted_utc", deleted.deleted_utc},
          {"ends_utc", tools.retention.ends_utc(deleted.deleted_utc)},
          {"session", std::move(session)}};
}

net::Response restore(const TrashTools& tools, const net::Request& request) {
  session::SessionRecord record = tools.sessions.restore(id_of(request));
  tell(tools, record, "restored");
  record.request = study::seen_by(request.caller, tools.studies, std::move(record.request));
  return net::json_response(200, api::to_json(record));
}

net::Response list(const TrashTools& tools, const net::Request& request) {
  const study::Blinding blinding = study::blinding_for(tools.studies, request.caller);
  std::vector<json> items;
  for (session::DeletedSession& deleted : tools.sessions.deleted())
    items.push_back(deleted_json(tools, blinding, std::move(deleted)));
  return page_of(request, "deleted", std::move(items), "-deleted_utc");
}

}  // namespace

void add_trash_routes(net::Router& router, const TrashTools& tools) {
  router.on("DELETE", trash_path + "/{id}",
            [tools](const net::Request& request) { return remove(tools, request); });
  router.on("POST", trash_path + "/{id}/restore",
            [tools](const net::Request& request) { return restore(tools, request); });
  router.on("GET", "/api/v1/trash", [tools](const net::Request& request) { return list(tools, request); });
}

}  // namespace ream::api
