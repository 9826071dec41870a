#include "api/replay_resource.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "api/request_body.hpp"
#include "core/error.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string sessions_path = "/api/v1/sessions";
constexpr double ticks_per_s = 1000.0;
/// Longer than any recording; the replay itself knows its duration.
constexpr double longest_s = 1e7;

net::Response create(const session::SessionService& sessions, session::ReplayService& replays,
                     const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  const session::SessionRecord of = sessions.get(id);
  if (is_live(of.status.state))
    throw Error(ErrorKind::conflict, "session '" + id + "' is " + to_text(of.status.state) +
                                         "; it can be replayed when it has ended");
  const session::ReplayRecord record = replays.create({{}, id, of.request.case_id, of.request.script});
  net::Response response = net::json_response(201, to_json(record));
  response.headers.emplace_back("Location", sessions_path + "/" + record.request.id);
  return response;
}

net::Response change(session::ReplayService& replays, const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  RequestBody body(request);
  session::PlaybackChange wanted;
  wanted.playing = body.flag_or_none("playing");
  wanted.speed = body.number_within_or_none("speed", 0.0, session::fastest_playback);
  wanted.position_s = body.number_within_or_none("position_s", 0.0, longest_s);
  body.finish();
  return net::json_response(200, to_json(replays.change(id, wanted)));
}

}  // namespace

json to_json(const session::ReplayRecord& record) {
  const session::PlaybackStatus& status = record.status;
  json marks = json::array();
  for (const session::ReplayMark& mark : record.marks)
    marks.push_back({{"at_s", mark.at_s}, {"kind", mark.kind}, {"words", mark.words}});
  return {{"id", record.request.id},
          {"kind", "replay"},
          {"replay_of", record.request.replay_of},
          {"case", record.request.case_id},
          {"script", record.request.script},
          {"state", record.open ? "replaying" : "stopped"},
          {"created_utc", record.created_utc},
          {"tick", std::llround(status.position_s * ticks_per_s)},
          {"duration_s", status.duration_s},
          {"force_scale", status.force_scale},
          {"fault", status.fault.empty() ? json(nullptr) : json(status.fault)},
          {"warning", status.warning.empty() ? json(nullptr) : json(status.warning)},
          {"playback",
           {{"position_s", status.position_s},
            {"duration_s", status.duration_s},
            {"speed", status.speed},
            {"playing", status.playing}}},
          {"marks", std::move(marks)}};
}

void add_replay_routes(net::Router& router, const session::SessionService& sessions,
                       session::ReplayService& replays, const Readiness& readiness) {
  router.on("POST", sessions_path + "/{id}/replay", [&](const net::Request& request) {
    readiness.require_prepared();
    return create(sessions, replays, request);
  });
  router.on("POST", sessions_path + "/{id}/playback",
            [&replays](const net::Request& request) { return change(replays, request); });
}

}  // namespace ream::api
