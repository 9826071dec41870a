#include "api/session_resource.hpp"

#include <nlohmann/json.hpp>

#include "api/replay_resource.hpp"
#include "api/request_body.hpp"
#include "core/error.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr double largest_force_scale = 1000.0;
constexpr size_t longest_reamer = 100, longest_profile = 64;
constexpr size_t longest_trainee = 100, longest_participant = 64, longest_title = 200;
const std::string base = "/api/v1/sessions";

json to_json(const TimingSummary& times) {
  return {{"mean_us", times.mean_us},
          {"p50_us", times.p50_us},
          {"p99_us", times.p99_us},
          {"p999_us", times.p999_us},
          {"max_us", times.max_us}};
}

json to_json(const LoopStatus& loop) {
  json told = to_json(loop.tick_us);
  told.update({{"missed", loop.missed},
               {"lateness", to_json(loop.lateness_us)},
               {"read", to_json(loop.read_us)},
               {"step", to_json(loop.step_us)},
               {"write", to_json(loop.write_us)},
               {"realtime", loop.realtime},
               {"memory_locked", loop.locked},
               {"cpu", loop.cpu < 0 ? json(nullptr) : json(loop.cpu)}});
  return told;
}

json to_json(const DeviceLinkStatus& device) {
  return {{"name", device.name},
          {"profile", device.profile},
          {"state", device.state.empty() ? json(nullptr) : json(device.state)},
          {"rtt_ms", device.rtt_ms ? json(*device.rtt_ms) : json(nullptr)},
          {"received", device.received},
          {"missing", device.missing},
          {"late", device.late},
          {"refused", device.refused}};
}

json to_json(const SessionRecord& record) {
  const SessionStatus& status = record.status;
  json told = labels_json(record.request);
  told.update({{"id", record.request.id},
               {"kind", "session"},
               {"case", record.request.case_id},
               {"script", record.request.script},
               {"state", to_text(status.state)},
               {"held", status.held},
               {"created_utc", record.request.created_utc},
               {"tick", status.tick},
               {"duration_s", status.duration_s},
               {"force_scale", status.force_scale},
               {"fault", status.fault.empty() ? json(nullptr) : json(status.fault)},
               {"streamable", record.streamable},
               {"loop", to_json(status.loop)},
               {"device", to_json(status.device)}});
  return told;
}

/// A trainee trains for nobody else.
void name_trainee(const net::Caller& caller, RequestBody& body, SessionRequest& wanted) {
  wanted.trainee_id = body.name_or("trainee_id", "");
  wanted.trainee = body.words("trainee", 0, longest_trainee);
  if (caller.role != "trainee") return;
  if (!wanted.trainee_id.empty() && wanted.trainee_id != caller.user_id)
    throw net::RequestError(403, "a trainee's sessions are their own; leave trainee_id out");
  wanted.trainee_id = caller.user_id;
  wanted.trainee = caller.name;
}

net::Response created(const SessionRecord& record) {
  net::Response response = net::json_response(201, to_json(record));
  response.headers.emplace_back("Location", base + "/" + record.request.id);
  return response;
}

net::Response create(SessionService& service, const Readiness& readiness, const std::string& usual_device,
                     const net::Request& request) {
  RequestBody body(request);
  SessionRequest wanted;
  wanted.case_id = body.name("case");
  wanted.device = body.name_or("device", usual_device);
  wanted.script = body.name_or("script", wanted.device == "script" ? "demo" : "practice");
  wanted.device_profile = body.words("device_profile", 0, longest_profile);
  wanted.force_scale = body.number_or_none("force_scale", 0.0, largest_force_scale);
  name_trainee(request.caller, body, wanted);
  wanted.study = body.name_or("study", "");
  wanted.participant = body.words("participant", 0, longest_participant);
  wanted.title = body.words("title", 0, longest_title);
  body.finish();
  readiness.require_prepared();
  return created(service.create(std::move(wanted)));
}

net::Response list(const SessionService& service, const ReplayService& replays) {
  json sessions = json::array();
  store::SessionQuery query;
  query.limit = SIZE_MAX;
  for (const SessionRecord& record : service.list(query).sessions) sessions.push_back(to_json(record));
  json open_replays = json::array();
  for (const ReplayRecord& record : replays.list()) open_replays.push_back(to_json(record));
  return net::json_response(200, {{"sessions", std::move(sessions)}, {"replays", std::move(open_replays)}});
}

const std::string& id_of(const net::Request& request) { return request.parameters.at("id"); }

net::Response resume(SessionService& service, const Readiness& readiness, const net::Request& request) {
  std::string reamer;
  if (!request.body.empty()) {
    RequestBody body(request);
    reamer = body.words("reamer", 0, longest_reamer);
    body.finish();
  }
  readiness.require_prepared();
  return net::json_response(200, to_json(service.resume(id_of(request), reamer)));
}

net::Response change(SessionService& service, const net::Request& request) {
  RequestBody body(request);
  SessionChange wanted;
  wanted.title = body.words_or_none("title", longest_title);
  wanted.keep = body.flag_or_none("keep");
  wanted.trainee_id = body.name_or_none("trainee_id");
  wanted.trainee = body.words_or_none("trainee", longest_trainee);
  body.finish();
  if (request.caller.role == "trainee" && (wanted.keep || wanted.trainee_id || wanted.trainee))
    throw net::RequestError(403, "a trainee may change the title only");
  return net::json_response(200, to_json(service.change(id_of(request), wanted)));
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

void add_session_routes(net::Router& router, SessionService& service, ReplayService& replays,
                        const Readiness& readiness, const std::string& usual_device) {
  router.on("GET", base, [&](const net::Request&) { return list(service, replays); });
  router.on("POST", base, [&, usual_device](const net::Request& request) {
    return create(service, readiness, usual_device, request);
  });
  router.on("GET", base + "/{id}", [&](const net::Request& request) {
    const std::string& id = id_of(request);
    return net::json_response(200, replays.has(id) ? to_json(replays.get(id)) : to_json(service.get(id)));
  });
  router.on("PATCH", base + "/{id}",
            [&service](const net::Request& request) { return change(service, request); });
  router.on("POST", base + "/{id}/pause", [&service](const net::Request& request) {
    return net::json_response(200, to_json(service.pause(id_of(request))));
  });
  router.on("POST", base + "/{id}/reset", [&](const net::Request& request) {
    readiness.require_prepared();
    return created(service.reset(id_of(request)));
  });
  router.on("POST", base + "/{id}/start", [&service](const net::Request& request) {
    return net::json_response(200, to_json(service.start(id_of(request))));
  });
  router.on("POST", base + "/{id}/stop", [&](const net::Request& request) {
    const std::string& id = id_of(request);
    return net::json_response(200, replays.has(id) ? to_json(replays.stop(id)) : to_json(service.stop(id)));
  });
  router.on("POST", base + "/{id}/resume",
            [&](const net::Request& request) { return resume(service, readiness, request); });
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
