#include "api/session_json.hpp"

#include <nlohmann/json.hpp>

#include "core/timing_json.hpp"
#include "session/folder/session_labels.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

json to_json(const TimingSummary& times) { return timing_json(times, TimingKeys::with_unit); }

json to_json(const sim::LoopHealth& loop) {
  const sim::RealtimeGrant& grant = loop.realtime;
  json told = to_json(loop.tick_us);
  told.update({{"missed", loop.missed},
               {"lateness", to_json(loop.lateness_us)},
               {"read", to_json(loop.read_us)},
               {"step", to_json(loop.step_us)},
               {"write", to_json(loop.write_us)},
               {"realtime", grant.fifo},
               {"memory_locked", grant.locked},
               {"cpu", grant.cpu < 0 ? json(nullptr) : json(grant.cpu)}});
  return told;
}

json to_json(const session::DeviceLinkStatus& device) {
  return {{"name", device.name},
          {"profile", device.profile},
          {"state", device.state.empty() ? json(nullptr) : json(device.state)},
          {"rtt_ms", device.rtt_ms ? json(*device.rtt_ms) : json(nullptr)},
          {"received", device.received},
          {"missing", device.missing},
          {"late", device.late},
          {"refused", device.refused}};
}

json to_json(const session::SessionMark& mark) {
  return {{"points", mark.points ? json(*mark.points) : json(nullptr)},
          {"outcome", mark.outcome.empty() ? json(nullptr) : json(mark.outcome)},
          {"rubric", mark.rubric},
          {"version", mark.version}};
}

}  // namespace

json to_json(const session::SessionRecord& record) {
  const session::SessionStatus& status = record.status;
  json told = session::labels_json(record.request);
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
               {"score", record.mark ? to_json(*record.mark) : json(nullptr)},
               {"loop", to_json(status.loop)},
               {"device", to_json(status.device)}});
  return told;
}

}  // namespace ream::api
