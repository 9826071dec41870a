#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

json place_json(const study::FeelPlace& place) {
  if (!place.trial) return {{"trial", nullptr}};
  return {{"trial",
           {{"number", place.trial->number},
            {"of", place.trial->of},
            {"comparison", place.trial->comparison->id},
            {"question", place.trial->comparison->question},
            {"session", or_null(place.session)}}}};
}

net::Response get_trial(const Services& services, const net::Request& request) {
  return net::json_response(
      200, place_json(services.feel.place(request.caller, id_of(request), request.parameters.at("code"))));
}

net::Response answer_trial(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  return net::json_response(
      200, place_json(services.feel.answer(request.caller, id_of(request), request.parameters.at("code"),
                                           body.at("number"), body.at("chosen"))));
}

net::Response get_report(const Services& services, const net::Request& request) {
  const std::string form = query_text(request, "form", "report");
  if (form == "answers") {
    const session::ExportTable table = services.feel.answers(request.caller, id_of(request));
    services.audit(request, "study.feel", id_of(request), form);
    return csv_response(table, id_of(request) + "-feel.csv");
  }
  const study::FeelReport report = services.feel.report(request.caller, id_of(request));
  services.audit(request, "study.feel", id_of(request), form);
  return net::json_response(200, to_json(report));
}

}  // namespace

std::vector<Route> feel_routes() {
  using namespace access;
  const std::string study = "/api/v1/studies/{id}", trial = study + "/participants/{code}/feel-trial";
  return {
      {"GET", trial, reamers, reads("study.feel_trial"), get_trial},
      {"PUT", trial, reamers, changes("study.feel_answer"), answer_trial, RouteChange{"study", "changed"}},
      {"GET", study + "/feel", staff, audited_by_handler, get_report}};
}

}  // namespace ream::api
