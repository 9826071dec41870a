#include "api/session_resource.hpp"

#include <nlohmann/json.hpp>

#include "api/replay_resource.hpp"
#include "api/request_body.hpp"
#include "core/error.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr double largest_force_scale = 1000.0;
constexpr size_t longest_reamer = 100;
const std::string base = "/api/v1/sessions";

json to_json(const SessionRecord& record) {
  const SessionStatus& status = record.status;
  const TimingSummary& tick = status.loop.tick_us;
  return {{"id", record.request.id},
          {"kind", "session"},
          {"case", record.request.case_id},
          {"script", record.request.script},
          {"state", to_text(status.state)},
          {"created_utc", record.request.created_utc},
          {"tick", status.tick},
          {"duration_s", status.duration_s},
          {"force_scale", status.force_scale},
          {"fault", status.fault.empty() ? json(nullptr) : json(status.fault)},
          {"streamable", record.streamable},
          {"loop",
           {{"mean_us", tick.mean_us},
            {"p50_us", tick.p50_us},
            {"p99_us", tick.p99_us},
            {"p999_us", tick.p999_us},
            {"max_us", tick.max_us},
            {"missed", status.loop.missed}}}};
}

net::Response create(SessionService& service, const Readiness& readiness, const net::Request& request) {
  RequestBody body(request);
  SessionRequest wanted;
  wanted.case_id = body.name("case");
  wanted.script = body.name("script");
  wanted.force_scale = body.number_or_none("force_scale", 0.0, largest_force_scale);
  body.finish();
  readiness.require_prepared();
  const SessionRecord record = service.create(std::move(wanted));
  net::Response response = net::json_response(201, to_json(record));
  response.headers.emplace_back("Location", base + "/" + record.request.id);
  return response;
}

net::Response list(const SessionService& service, const ReplayService& replays) {
  json sessions = json::array();
  for (const SessionRecord& record : service.list()) sessions.push_back(to_json(record));
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
                        const Readiness& readiness) {
  router.on("GET", base, [&](const net::Request&) { return list(service, replays); });
  router.on("POST", base, [&](const net::Request& request) { return create(service, readiness, request); });
  router.on("GET", base + "/{id}", [&](const net::Request& request) {
    const std::string& id = id_of(request);
    return net::json_response(200, replays.has(id) ? to_json(replays.get(id)) : to_json(service.get(id)));
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
}

}  // namespace ream::api
