#include "api/annotation_resource.hpp"

#include <nlohmann/json.hpp>

#include "api/request_body.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr size_t longest_words = 4000, longest_author = 100;
constexpr double longest_session_s = 4e6, farthest_mm = 1e6;

json annotation_json(const session::Annotation& annotation) {
  json place;
  if (const auto& p = annotation.place_mm) place = {p->x(), p->y(), p->z()};
  return {{"utc", annotation.utc},
          {"words", annotation.words},
          {"author", annotation.author},
          {"at_s", annotation.at_s},
          {"place_mm", std::move(place)}};
}

net::Response annotate(session::SessionService& service, const net::Request& request) {
  RequestBody body(request);
  session::NewAnnotation note;
  note.words = body.words("words", 1, longest_words);
  note.author = body.words("author", 0, longest_author);
  note.at_s = body.number_within_or_none("at_s", 0.0, longest_session_s);
  note.place_mm = body.point_or_none("place_mm", farthest_mm);
  body.finish();
  const std::string& id = request.parameters.at("id");
  // The remark goes into the recording, which others read: who takes part in a study signs by code.
  if (const session::SessionRequest session = service.get(id).request;
      !session.participant.empty() && !request.caller.user_id.empty() &&
      request.caller.user_id == session.trainee_id)
    note.author = session.participant;
  return net::json_response(201, annotation_json(service.annotate(id, note)));
}

net::Response list(const session::SessionService& service, const net::Request& request) {
  json annotations = json::array();
  for (const session::Annotation& annotation : service.annotations(request.parameters.at("id")))
    annotations.push_back(annotation_json(annotation));
  return net::json_response(200, {{"annotations", std::move(annotations)}});
}

}  // namespace

void add_annotation_routes(net::Router& router, session::SessionService& service) {
  const std::string path = "/api/v1/sessions/{id}/annotations";
  router.on("GET", path, [&service](const net::Request& request) { return list(service, request); });
  router.on("POST", path, [&service](const net::Request& request) { return annotate(service, request); });
}

}  // namespace ream::api
