
#include <nlohmann/json.hpp>

#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

json annotation_json(const session::Annotation& annotation) {
  json place;
  if (const auto& p = annotation.place_mm) place = {p->x(), p->y(), p->z()};
  return {{"utc", annotation.utc},
          {"words", annotation.words},
          {"author", annotation.author},
          {"at_s", annotation.at_s},
          {"place_mm", std::move(place)}};
}

net::Response annotate(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  session::NewAnnotation note{body.at("words"), text_in(body, "author"), optional_in<double>(body, "at_s"),
                              point_in(body, "place_mm")};
  const std::string& id = id_of(request);
  // Who is logged in signs by that name: no other can be given.
  if (!request.caller.user_id.empty()) note.author = request.caller.name;
  // The remark goes into the recording, which others read: who takes part in a study signs by code.
  if (const session::SessionRequest session = services.sessions.get(id).request;
      !session.participant.empty() && !request.caller.user_id.empty() &&
      request.caller.user_id == session.trainee_id)
    note.author = session.participant;
  return net::json_response(201, annotation_json(services.sessions.annotate(id, note)));
}

net::Response list_annotations(const Services& services, const net::Request& request) {
  json annotations = json::array();
  for (const session::Annotation& annotation : services.sessions.annotations(id_of(request)))
    annotations.push_back(annotation_json(annotation));
  return net::json_response(200, {{"annotations", std::move(annotations)}});
}

}  // namespace

std::vector<Route> annotation_routes() {
  const std::string annotations = "/api/v1/sessions/{id}/annotations";
  return {{"GET", annotations, access::all_roles, reads("session.annotations"), list_annotations},
          {"POST", annotations, access::reamers, not_audited, annotate, {"session", "annotated"}}};
}

}  // namespace ream::api
