#include "openigtlink/telemetry_messages.hpp"

#include <array>

#include "openigtlink/messages.hpp"

namespace ream::openigtlink {
namespace {

constexpr double m_per_mm = 1.0e-3;

struct Status {
  StatusCode code;
  const char* name;
  const char* text;
};

Status status_of(SessionState state) {
  switch (state) {
    case SessionState::created: return {StatusCode::not_ready, "created", "the session has not been started"};
    case SessionState::running:
    case SessionState::replaying: return {StatusCode::ok, "running", "the session runs"};
    case SessionState::paused: return {StatusCode::not_ready, "paused", "the session is paused"};
    case SessionState::finished:
      return {StatusCode::shut_down, "finished", "the session has come to its end"};
    case SessionState::stopped: return {StatusCode::shut_down, "stopped", "the session was stopped"};
    case SessionState::fault:
    case SessionState::interrupted: break;
  }
  return {StatusCode::hardware_failure, "fault", "the session ended by a fault"};
}

void put_status(const stream::TelemetrySample& tick, int64_t unix_ns, LastSent& sent, MessageCache& cache) {
  Status now = status_of(tick.state);
  std::string text = now.text;
  if (tick.fault[0] != '\0') {
    now.code = StatusCode::hardware_failure;
    text = tick.fault.data();
  }
  const std::string all = now.name + (": " + text);
  if (all == sent.status) return;
  sent.status = all;
  cache.put(Topic::status, status_message({"Simulator", unix_ns}, now.code, now.name, text));
}

}  // namespace

void put_session(const SessionView& session, int64_t unix_ns, MessageCache& cache) {
  cache.put(Topic::session, string_message({"Session", unix_ns}, session.id + ": " + session.description));
  cache.put(Topic::reamer, polydata_message({"Reamer", unix_ns}, session.tool));
  cache.put(Topic::bone_pose, transform_message({"BoneToRas", unix_ns}, Pose{}));
}

void put_tick(const stream::TelemetrySample& tick, int64_t unix_ns, LastSent& sent, MessageCache& cache) {
  cache.put(Topic::reamer_pose, transform_message({"ReamerToRas", unix_ns}, ras_from(tick.world_from_tool)));
  if (tick.world_from_bone_rest || sent.bone_moved)
    cache.put(Topic::bone_pose, transform_message({"BoneToRas", unix_ns},
                                                  moved_in_ras(tick.world_from_bone_rest.value_or(Pose{}))));
  sent.bone_moved = tick.world_from_bone_rest.has_value();
  const std::array<double, 2> force_n{tick.thrust_n, tick.hand_force_n};
  cache.put(Topic::force, sensor_message({"Force", unix_ns}, force_n, SensorUnit::newton));
  const std::array<double, 1> torque_n_m{m_per_mm * tick.torque_n_mm};
  cache.put(Topic::torque, sensor_message({"Torque", unix_ns}, torque_n_m, SensorUnit::newton_metre));
  put_status(tick, unix_ns, sent, cache);
}

void put_no_session(int64_t unix_ns, MessageCache& cache) {
  cache.put(Topic::status, status_message({"Simulator", unix_ns}, StatusCode::not_ready, "no session",
                                          "no session has been started"));
}

}  // namespace ream::openigtlink
