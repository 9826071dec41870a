#include "api/session_resource.hpp"

#include <nlohmann/json.hpp>

#include "api/replay_resource.hpp"
#include "api/request_body.hpp"
#include "api/session_json.hpp"
#include "api/session_list.hpp"
#include "core/error.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr double largest_force_scale = 1000.0;
constexpr size_t longest_reamer = 100, longest_profile = 64;
constexpr size_t longest_trainee = 100, longest_participant = 64, longest_title = 200;
const std::string base = "/api/v1/sessions";

/// A trainee trains for nobody else.
void name_trainee(const net::Caller& caller, session::SessionRequest& wanted) {
  if (caller.role != "trainee") return;
  if (!wanted.trainee_id.empty() && wanted.trainee_id != caller.user_id)
    throw net::RequestError(403, "a trainee's sessions are their own; leave trainee_id out");
  wanted.trainee_id = caller.user_id;
  wanted.trainee = caller.name;
}

/// The same as the caller may know it.
json seen(const study::StudyService* studies, const net::Request& request, session::SessionRecord record) {
  record.request = study::seen_by(request.caller, studies, std::move(record.request));
  return to_json(record);
}

net::Response created(const study::StudyService* studies, const net::Request& request,
                      const session::SessionRecord& record) {
  net::Response response = net::json_response(201, seen(studies, request, record));
  response.headers.emplace_back("Location", base + "/" + record.request.id);
  return response;
}

/// In a study the study says how it is and who trains.
void take_study(const study::StudyService* studies, const net::Request& request,
                session::SessionRequest& wanted) {
  if (wanted.study.empty()) {
    if (!wanted.participant.empty())
      throw net::RequestError(422, "'participant' needs 'study'", {{"#/participant", "needs a study"}});
    return;
  }
  if (!studies) throw Error(ErrorKind::not_found, "no study '" + wanted.study + "'");
  if (!wanted.device.empty() || !wanted.script.empty() || !wanted.device_profile.empty() ||
      wanted.force_scale || !wanted.trainee_id.empty() || !wanted.trainee.empty())
    throw net::RequestError(422,
                            "the study says device, script, force scale and trainee; leave them out and name "
                            "the participant",
                            {{"#/study", "says device, script, force scale and trainee"}});
  studies->admit(request.caller, wanted);
}

net::Response create(session::SessionService& service, const study::StudyService* studies,
                     const Readiness& readiness, const std::string& default_device,
                     const net::Request& request) {
  RequestBody body(request);
  session::SessionRequest wanted;
  wanted.case_id = body.name("case");
  wanted.device = body.name_or("device", "");
  wanted.script = body.name_or("script", "");
  wanted.device_profile = body.words("device_profile", 0, longest_profile);
  wanted.force_scale = body.number_or_none("force_scale", 0.0, largest_force_scale);
  wanted.trainee_id = body.name_or("trainee_id", "");
  wanted.trainee = body.words("trainee", 0, longest_trainee);
  wanted.study = body.name_or("study", "");
  wanted.participant = body.words("participant", 0, longest_participant);
  wanted.title = body.words("title", 0, longest_title);
  wanted.theatre = body.flag_or_none("theatre").value_or(false);
  body.finish();
  readiness.require_prepared();
  take_study(studies, request, wanted);
  if (wanted.study.empty()) name_trainee(request.caller, wanted);
  if (wanted.device.empty()) wanted.device = default_device;
  if (wanted.script.empty()) wanted.script = wanted.device == "script" ? "demo" : "practice";
  return created(studies, request, service.create(std::move(wanted)));
}

net::Response resume(session::SessionService& service, const study::StudyService* studies,
                     const Readiness& readiness, const net::Request& request) {
  std::string reamer;
  if (!request.body.empty()) {
    RequestBody body(request);
    reamer = body.words("reamer", 0, longest_reamer);
    body.finish();
  }
  readiness.require_prepared();
  return net::json_response(200, seen(studies, request, service.resume(id_of(request), reamer)));
}

net::Response change(session::SessionService& service, const study::StudyService* studies,
                     const net::Request& request) {
  RequestBody body(request);
  session::SessionChange wanted;
  wanted.title = body.words_or_none("title", longest_title);
  wanted.keep = body.flag_or_none("keep");
  wanted.trainee_id = body.name_or_none("trainee_id");
  wanted.trainee = body.words_or_none("trainee", longest_trainee);
  body.finish();
  if (request.caller.role == "trainee" && (wanted.keep || wanted.trainee_id || wanted.trainee))
    throw net::RequestError(403, "a trainee may change the title only");
  if ((wanted.trainee_id || wanted.trainee) && !service.get(id_of(request)).request.study.empty())
    throw Error(ErrorKind::conflict, "who trains in session '" + id_of(request) + "' is said by its study");
  return net::json_response(200, seen(studies, request, service.change(id_of(request), wanted)));
}

/// For slow links: the surface with one sample every 2 or 4 voxels.
int stride_of(const net::Request& request) {
  const auto given = request.query.find("stride");
  if (given == request.query.end()) return 1;
  for (const int stride : {1, 2, 4})
    if (given->second == std::to_string(stride)) return stride;
  throw Error(ErrorKind::invalid_input, "stride must be 1, 2 or 4, not '" + given->second + "'");
}

}  // namespace

void add_session_routes(net::Router& router, session::SessionService& service,
                        session::ReplayService& replays, const Readiness& readiness,
                        const std::string& default_device, const study::StudyService* studies) {
  router.on("GET", base, [&, studies](const net::Request& request) {
    return list_sessions(service, studies, replays, request);
  });
  router.on("POST", base, [&, studies, default_device](const net::Request& request) {
    return create(service, studies, readiness, default_device, request);
  });
  router.on("GET", base + "/{id}", [&, studies](const net::Request& request) {
    const std::string& id = id_of(request);
    return net::json_response(
        200, replays.has(id) ? to_json(replays.get(id)) : seen(studies, request, service.get(id)));
  });
  router.on("PATCH", base + "/{id}",
            [&service, studies](const net::Request& request) { return change(service, studies, request); });
  router.on("POST", base + "/{id}/pause", [&service, studies](const net::Request& request) {
    return net::json_response(200, seen(studies, request, service.pause(id_of(request))));
  });
  router.on("POST", base + "/{id}/reset", [&, studies](const net::Request& request) {
    readiness.require_prepared();
    return created(studies, request, service.reset(id_of(request)));
  });
  router.on("POST", base + "/{id}/start", [&service, studies](const net::Request& request) {
    return net::json_response(200, seen(studies, request, service.start(id_of(request))));
  });
  router.on("POST", base + "/{id}/stop", [&, studies](const net::Request& request) {
    const std::string& id = id_of(request);
    return net::json_response(
        200, replays.has(id) ? to_json(replays.stop(id)) : seen(studies, request, service.stop(id)));
  });
  router.on("POST", base + "/{id}/resume", [&, studies](const net::Request& request) {
    return resume(service, studies, readiness, request);
  });
  router.on("GET", base + "/{id}/metrics", [&](const net::Request& request) {
    const std::string& id = id_of(request);
    return net::json_response(200, replays.has(id) ? replays.metrics(id) : service.metrics(id));
  });
  router.on_websocket(base + "/{id}/stream", [&](const net::Request& request) {
    const std::string& id = id_of(request);
    return replays.has(id) ? replays.subscribe(id, stride_of(request))
                           : service.subscribe(id, stride_of(request));
  });
  router.on_websocket(base + "/{id}/device", [&](const net::Request& request) {
    const std::string& id = id_of(request);
    if (replays.has(id))
      throw Error(ErrorKind::conflict, "'" + id + "' is a replay; no device connects to it");
    return service.connect_device(id);
  });
}

}  // namespace ream::api
