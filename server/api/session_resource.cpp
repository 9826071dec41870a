#include "access/role.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_list.hpp"
#include "case/two_plates.hpp"
#include "core/error.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string sessions_path = "/api/v1/sessions";

session::SessionRequest session_request_from(const json& body) {
  session::SessionRequest wanted;
  wanted.case_id = text_in(body, "case");
  wanted.device = text_in(body, "device");
  wanted.script = text_in(body, "script");
  wanted.device_profile = text_in(body, "device_profile");
  wanted.force_scale = optional_in<double>(body, "force_scale");
  wanted.trainee_id = text_in(body, "trainee_id");
  wanted.trainee = text_in(body, "trainee");
  wanted.study = text_in(body, "study");
  wanted.participant = text_in(body, "participant");
  wanted.title = text_in(body, "title");
  wanted.theatre = body.value("theatre", false);
  return wanted;
}

session::SessionChange session_change_from(const json& body) {
  return {optional_in<std::string>(body, "title"), optional_in<std::string>(body, "trainee_id"),
          optional_in<std::string>(body, "trainee"), optional_in<bool>(body, "keep")};
}

bool is_trainee(const net::Caller& caller) { return caller.role == "trainee"; }

/// A trainee trains for nobody else.
void name_trainee(const net::Caller& caller, session::SessionRequest& wanted) {
  if (!is_trainee(caller)) return;
  if (!wanted.trainee_id.empty() && wanted.trainee_id != caller.user_id)
    throw net::RequestError(403, "a trainee's sessions are their own; leave trainee_id out");
  wanted.trainee_id = caller.user_id;
  wanted.trainee = caller.name;
}

net::Response reply_with(const Services& services, const net::Request& request,
                         const session::SessionRecord& record) {
  return net::json_response(200, to_json(services.seen(request.caller, record)));
}

net::Response created_session(const Services& services, const net::Request& request,
                              const session::SessionRecord& record) {
  return created(sessions_path + "/" + record.request.id, to_json(services.seen(request.caller, record)));
}

/// In a study the study says how it is and who trains.
void take_study(const Services& services, const net::Caller& caller, session::SessionRequest& wanted) {
  if (wanted.study.empty()) {
    if (!wanted.participant.empty())
      throw net::RequestError(422, "'participant' needs 'study'", {{"#/participant", "needs a study"}});
    if (wanted.case_id.empty())
      throw net::RequestError(422, "'case' is missing; only a study knows which case is next",
                              {{"#/case", "is missing"}});
    if (case_::is_two_plates(wanted.case_id) && !access::is_operator(caller.role))
      throw Error(ErrorKind::not_found, "no case '" + wanted.case_id + "'");
    return;
  }
  if (!wanted.device.empty() || !wanted.script.empty() || !wanted.device_profile.empty() ||
      wanted.force_scale || !wanted.trainee_id.empty() || !wanted.trainee.empty())
    throw net::RequestError(422,
                            "the study says device, script, force scale and trainee; leave them out and name "
                            "the participant",
                            {{"#/study", "says device, script, force scale and trainee"}});
  services.studies.admit(caller, wanted);
}

net::Response create_session(const Services& services, const net::Request& request) {
  session::SessionRequest wanted = session_request_from(body_of(request));
  services.readiness.require_prepared();
  take_study(services, request.caller, wanted);
  if (wanted.study.empty()) name_trainee(request.caller, wanted);
  wanted.at_most_scripts_scale = wanted.study.empty() && is_trainee(request.caller);
  if (wanted.device.empty()) wanted.device = services.default_device;
  if (wanted.script.empty()) wanted.script = wanted.device == "script" ? "demo" : "practice";
  return created_session(services, request,
                         services.sessions.create(std::move(wanted), is_trainee(request.caller)));
}

net::Response get_session(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  if (services.replays.has(id)) return net::json_response(200, to_json(services.replays.get(id)));
  return reply_with(services, request, services.sessions.get(id));
}

net::Response change_session(const Services& services, const net::Request& request) {
  const session::SessionChange wanted = session_change_from(body_of(request));
  const std::string& id = id_of(request);
  if (is_trainee(request.caller) && (wanted.keep || wanted.trainee_id || wanted.trainee))
    throw net::RequestError(403, "a trainee may change the title only");
  if ((wanted.trainee_id || wanted.trainee) && !services.sessions.get(id).request.study.empty())
    throw Error(ErrorKind::conflict, "who trains in session '" + id + "' is said by its study");
  return reply_with(services, request, services.sessions.change(id, wanted));
}

net::Response start_session(const Services& services, const net::Request& request) {
  return reply_with(services, request, services.sessions.start(id_of(request)));
}

net::Response pause_session(const Services& services, const net::Request& request) {
  return reply_with(services, request, services.sessions.pause(id_of(request)));
}

net::Response stop_session(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  if (services.replays.has(id)) return net::json_response(200, to_json(services.replays.stop(id)));
  return reply_with(services, request, services.sessions.stop(id));
}

net::Response reset_session(const Services& services, const net::Request& request) {
  services.readiness.require_prepared();
  services.studies.require_repeatable(services.sessions.get(id_of(request)).request);
  return created_session(services, request,
                         services.sessions.reset(id_of(request), is_trainee(request.caller)));
}

net::Response resume_session(const Services& services, const net::Request& request) {
  services.readiness.require_prepared();
  services.studies.require_repeatable(services.sessions.get(id_of(request)).request);
  const std::string reamer = text_in(body_of(request), "reamer");
  return reply_with(services, request,
                    services.sessions.resume(id_of(request), reamer, is_trainee(request.caller)));
}

net::Response get_metrics(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  if (!services.replays.has(id)) return net::json_response(200, services.sessions.metrics(id));
  if (services.replays.get(id).request.blind)
    throw net::RequestError(403, "'" + id + "' is a replay for rating; its metrics are hidden");
  return net::json_response(200, services.replays.metrics(id));
}

/// For slow links the surface may have one sample every 2 or 4 voxels.
std::unique_ptr<net::WebSocketSession> open_stream(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const int stride = static_cast<int>(query_number(request, "stride", 1.0));
  return services.replays.has(id) ? services.replays.subscribe(id, stride)
                                  : services.sessions.subscribe(id, stride);
}

std::unique_ptr<net::WebSocketSession> open_device(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  if (services.replays.has(id))
    throw Error(ErrorKind::conflict, "'" + id + "' is a replay; no device connects to it");
  return services.sessions.connect_device(id);
}

}  // namespace

std::vector<Route> session_routes() {
  using access::all_roles, access::reamers;
  const std::string one = sessions_path + "/{id}";
  return {{"GET", sessions_path, all_roles, not_audited, list_sessions},
          {"POST", sessions_path, reamers, not_audited, create_session},
          {"GET", one, all_roles, not_audited, get_session},
          {"PATCH", one, reamers, changes("session.change"), change_session, {"session", "changed"}},
          {"POST", one + "/start", reamers, not_audited, start_session},
          {"POST", one + "/pause", reamers, not_audited, pause_session, {}, net::Urgency::halt},
          {"POST", one + "/stop", reamers, not_audited, stop_session, {}, net::Urgency::halt},
          {"POST", one + "/reset", reamers, not_audited, reset_session},
          {"POST", one + "/resume", reamers, not_audited, resume_session},
          {"GET", one + "/metrics", all_roles, not_audited, get_metrics},
          {"GET", one + "/stream", all_roles, reads("session.watch"), open_stream},
          {"GET", one + "/device", reamers, reads("session.device"), open_device}};
}

}  // namespace ream::api
