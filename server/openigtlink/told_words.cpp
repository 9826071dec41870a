#include "openigtlink/told_words.hpp"

#include <array>

#include "openigtlink/ras.hpp"

namespace ream::openigtlink {
namespace {

using stream::SessionState;

constexpr double m_per_mm = 1.0e-3;

struct Told {
  StatusCode code;
  const char* name;
  const char* words;
};

Told told_of(SessionState state) {
  switch (state) {
    case SessionState::created:
      return {StatusCode::not_ready, "created", "the session has not been started"};
    case SessionState::running:
    case SessionState::replaying:
      return {StatusCode::ok, "running", "the session runs"};
    case SessionState::paused:
      return {StatusCode::not_ready, "paused", "the session is paused"};
    case SessionState::finished:
      return {StatusCode::shut_down, "finished", "the session has come to its end"};
    case SessionState::stopped:
      return {StatusCode::shut_down, "stopped", "the session was stopped"};
    case SessionState::fault:
    case SessionState::interrupted:
      break;
  }
  return {StatusCode::hardware_failure, "fault", "the session ended by a fault"};
}

void tell_status(const stream::TelemetrySample& tick, int64_t unix_ns, AlreadyTold& told, Board& board) {
  Told now = told_of(tick.state);
  std::string words = now.words;
  if (tick.fault[0] != '\0') {
    now.code = StatusCode::hardware_failure;
    words = tick.fault.data();
  }
  const std::string all = now.name + (": " + words);
  if (all == told.status) return;
  told.status = all;
  board.put(Topic::status, status_message({"Simulator", unix_ns}, now.code, now.name, words));
}

}  // namespace

void tell_session(const ShownSession& session, int64_t unix_ns, Board& board) {
  board.put(Topic::session, string_message({"Session", unix_ns}, session.id + ": " + session.words));
  board.put(Topic::reamer, polydata_message({"Reamer", unix_ns}, session.tool));
  board.put(Topic::bone_pose, transform_message({"BoneToRas", unix_ns}, Pose{}));
}

void tell_tick(const stream::TelemetrySample& tick, int64_t unix_ns, AlreadyTold& told, Board& board) {
  board.put(Topic::reamer_pose, transform_message({"ReamerToRas", unix_ns}, ras_from(tick.world_from_tool)));
  if (tick.world_from_bone_rest || told.bone_moved)
    board.put(Topic::bone_pose, transform_message({"BoneToRas", unix_ns},
                                                  moved_in_ras(tick.world_from_bone_rest.value_or(Pose{}))));
  told.bone_moved = tick.world_from_bone_rest.has_value();
  const std::array<double, 2> force_n{tick.thrust_n, tick.hand_force_n};
  board.put(Topic::force, sensor_message({"Force", unix_ns}, force_n, SensorUnit::newton));
  const std::array<double, 1> torque_n_m{m_per_mm * tick.torque_n_mm};
  board.put(Topic::torque, sensor_message({"Torque", unix_ns}, torque_n_m, SensorUnit::newton_metre));
  tell_status(tick, unix_ns, told, board);
}

void tell_nothing_runs(int64_t unix_ns, Board& board) {
  board.put(Topic::status, status_message({"Simulator", unix_ns}, StatusCode::not_ready, "no session",
                                          "no session has been started"));
}

}  // namespace ream::openigtlink
