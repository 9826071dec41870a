#include "api/replies.hpp"

#include <nlohmann/json.hpp>

#include "api/request_values.hpp"
#include "core/timing_json.hpp"
#include "session/folder/session_labels.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

json times_json(const TimingSummary& times) { return timing_json(times, TimingKeys::with_unit); }

json loop_json(const sim::LoopHealth& loop) {
  const sim::RealtimeGrant& grant = loop.realtime;
  json view = times_json(loop.tick_us);
  view.update({{"missed", loop.missed},
               {"lateness", times_json(loop.lateness_us)},
               {"read", times_json(loop.read_us)},
               {"step", times_json(loop.step_us)},
               {"write", times_json(loop.write_us)},
               {"realtime", grant.fifo},
               {"memory_locked", grant.locked},
               {"cpu", grant.cpu < 0 ? json(nullptr) : json(grant.cpu)}});
  return view;
}

json device_json(const session::DeviceLinkStatus& device) {
  return {{"name", device.name},
          {"profile", device.profile},
          {"state", device.state.empty() ? json(nullptr) : json(device.state)},
          {"rtt_ms", device.rtt_ms ? json(*device.rtt_ms) : json(nullptr)},
          {"received", device.received},
          {"missing", device.missing},
          {"late", device.late},
          {"refused", device.refused}};
}

json mark_json(const session::SessionMark& mark) {
  return {{"points", mark.points ? json(*mark.points) : json(nullptr)},
          {"outcome", mark.outcome.empty() ? json(nullptr) : json(mark.outcome)},
          {"rubric", mark.rubric},
          {"version", mark.version}};
}

}  // namespace

json to_json(const session::SessionRecord& record) {
  const session::SessionStatus& status = record.status;
  json view = session::labels_json(record.request);
  view.update({{"id", record.request.id},
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
               {"score", record.mark ? mark_json(*record.mark) : json(nullptr)},
               {"loop", loop_json(status.loop)},
               {"device", device_json(status.device)}});
  return view;
}

json to_json(const study::Participant& participant) {
  const bool known = !participant.experience.empty();
  return {{"code", participant.code},
          {"experience", or_null(participant.experience)},
          {"procedures_done", known ? json(participant.procedures_done) : json(nullptr)},
          {"answers", participant.answers.value_or(json(nullptr))},
          {"has_account", participant.has_account},
          {"arm", or_null(participant.arm)}};
}

json user_json(const access::User& user) {
  return {{"id", user.id},
          {"name", user.name},
          {"display_name", user.display_name},
          {"role", access::to_text(user.role)},
          {"enabled", user.enabled},
          {"created_utc", user.created_utc}};
}

net::Response created(const std::string& where, const json& body) {
  net::Response response = net::json_response(201, body);
  response.headers.emplace_back("Location", where);
  return response;
}

net::Response csv_response(const session::ExportTable& table, const std::string& file) {
  net::Response response =
      net::bytes_response(200, "text/csv; charset=utf-8; header=present", net::share(session::csv_of(table)));
  response.headers.emplace_back("Content-Disposition", "attachment; filename=\"" + file + "\"");
  return response;
}

net::Response no_content() { return {204, {}, nullptr, {}}; }

}  // namespace ream::api
