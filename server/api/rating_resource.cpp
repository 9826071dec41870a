#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/text.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string study_path = "/api/v1/studies/{id}";

const std::string& key_of(const net::Request& request) { return request.parameters.at("key"); }

json rater_json(const study::Rater& rater) {
  return {{"label", rater.label},
          {"user_id", or_null(rater.user_id)},
          {"name", rater.name},
          {"rated", rater.rated},
          {"to_rate", rater.to_rate}};
}

json queued_json(const study::QueuedRating& one) {
  return {{"key", one.key}, {"answers", one.answers.value_or(json(nullptr))}};
}

net::Response list_raters(const Services& services, const net::Request& request) {
  json list = json::array();
  for (const study::Rater& rater : services.ratings.raters(request.caller, id_of(request)))
    list.push_back(rater_json(rater));
  return net::json_response(200, {{"raters", std::move(list)}});
}

net::Response add_rater(const Services& services, const net::Request& request) {
  const study::Rater rater =
      services.ratings.add(request.caller, id_of(request), body_of(request).at("user_id"));
  services.audit(request, "study.rater.add", id_of(request), rater.label + ": " + rater.name);
  return created("/api/v1/studies/" + id_of(request) + "/raters/" + rater.label, rater_json(rater));
}

net::Response remove_rater(const Services& services, const net::Request& request) {
  const std::string& label = request.parameters.at("label");
  services.ratings.remove(id_of(request), label);
  services.audit(request, "study.rater.remove", id_of(request), label + " and all ratings");
  return no_content();
}

net::Response get_queue(const Services& services, const net::Request& request) {
  json list = json::array();
  for (const study::QueuedRating& one : services.ratings.queue(request.caller, id_of(request)))
    list.push_back(queued_json(one));
  return net::json_response(200, {{"queue", std::move(list)}});
}

/// The replay has an id of its own and does not say which session it is of.
net::Response open_replay(const Services& services, const net::Request& request) {
  services.readiness.require_prepared();
  const std::string id = services.ratings.queued(request.caller, id_of(request), key_of(request)).session;
  const session::SessionRequest session = services.sessions.get(id).request;
  const session::ReplayRecord record =
      services.replays.create({{}, id, session.case_id, session.script, request.caller.user_id, true});
  return created("/api/v1/sessions/" + record.request.id, to_json(record));
}

net::Response rate_session(const Services& services, const net::Request& request) {
  services.ratings.rate(request.caller, id_of(request), key_of(request), body_of(request));
  return net::json_response(
      200, queued_json(services.ratings.queued(request.caller, id_of(request), key_of(request))));
}

}  // namespace

std::vector<Route> rating_routes() {
  using namespace access;
  const std::string raters = study_path + "/raters", queue = study_path + "/rating-queue",
                    one = queue + "/{key}";
  const RouteChange changed{"study", "changed"};
  return {{"GET", raters, staff, reads("study.raters"), list_raters},
          {"POST", raters, operators, audited_by_handler, add_rater},
          {"DELETE", raters + "/{label}", operators, audited_by_handler, remove_rater, changed},
          {"GET", queue, staff, reads("study.rating_queue"), get_queue},
          {"PUT", one, staff, changes("study.rate"), rate_session, changed},
          {"POST", one + "/replay", staff, reads("session.replay"), open_replay}};
}

}  // namespace ream::api
