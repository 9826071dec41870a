#include <cmath>
#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_work.hpp"
#include "api/visibility.hpp"
#include "core/error.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr double ticks_per_s = 1000.0;

net::Response create_replay(const Services& services, const net::Request& request) {
  services.readiness.require_prepared();
  const std::string& id = id_of(request);
  const session::SessionRecord of = services.sessions.get(id);
  require_ended(of, "it can be replayed when it has ended");
  const session::ReplayRecord record =
      services.replays.create({{}, id, of.request.case_id, of.request.script, counted_for(request.caller)});
  return created("/api/v1/sessions/" + record.request.id, to_json(record));
}

net::Response change_playback(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  return net::json_response(
      200, to_json(services.replays.change(
               id_of(request), {optional_in<bool>(body, "playing"), optional_in<double>(body, "speed"),
                                optional_in<double>(body, "position_s")})));
}

}  // namespace

json to_json(const session::ReplayRecord& record) {
  const session::PlaybackStatus& status = record.status;
  const bool blind = record.request.blind;
  json marks = json::array();
  for (const session::ReplayMark& mark : blind ? std::vector<session::ReplayMark>() : record.marks)
    marks.push_back({{"at_s", mark.at_s}, {"kind", mark.kind}, {"words", mark.words}});
  return {{"id", record.request.id},
          {"kind", "replay"},
          {"replay_of", blind ? json(nullptr) : json(record.request.replay_of)},
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

std::vector<Route> replay_routes() {
  const std::string one = "/api/v1/sessions/{id}";
  return {{"POST",
           one + "/replay",
           access::all_roles,
           reads("session.replay"),
           create_replay,
           {"replay", "created"}},
          {"POST", one + "/playback", access::all_roles, not_audited, change_playback}};
}

}  // namespace ream::api
