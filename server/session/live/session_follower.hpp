#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "device/network/device_socket.hpp"
#include "score/live_score.hpp"
#include "session/live/live_state.hpp"
#include "session/live/loop_rings.hpp"
#include "session/live/session_files.hpp"
#include "sim/black_box.hpp"
#include "sim/cpu_allocator.hpp"
#include "sim/haptic_loop.hpp"
#include "stream/mesh_publisher.hpp"
#include "stream/telemetry.hpp"

namespace ream::session {

/// Follows the haptic loop of a live session on a thread of its own and keeps files, metrics, telemetry and
/// the streamed surface up to date; ends the session when the loop ends, stands still or cannot be recorded.
/// The bone is on its viewers' screens before it starts.
class SessionFollower {
 public:
  /// All of it outlives the follower. `device_port`: null where the device does not connect over the network.
  /// `metrics`: of what a resumed session has done before. `start_coverage`: of the bone before a resumed
  /// session's first tick, else null; not needed afterwards.
  SessionFollower(const Simulation& simulation, LoopRings& rings, sim::HapticLoop& loop,
                  device::DevicePort* device_port, stream::Fanout& fanout, LiveState& state,
                  const score::MetricsAccumulator& metrics, const std::vector<uint8_t>* start_coverage);
  /// Ends the thread; the session has been stopped before.
  ~SessionFollower();
  SessionFollower(const SessionFollower&) = delete;
  SessionFollower& operator=(const SessionFollower&) = delete;

  /// The bone as viewers have it: for a recorder, which must have each change before viewers do.
  const uint8_t* coverage() const { return publisher_.replica().coverage().data(); }
  /// The session begins: from now on the files and the loop's share of a CPU are the follower's, which lets
  /// go of both at the end. Once, before the loop starts.
  void begin(std::unique_ptr<SessionFiles> files,
             std::unique_ptr<sim::CpuAllocator::Reservation> cpu_reservation);

 private:
  void run();
  void follow();
  void follow_once();
  void drain_rings(bool loop_ended);
  void note_events(const record::TickReport& report);
  void note_progress();
  nlohmann::json metrics_json(const score::MetricsAccumulator& metrics) const;
  void note_device_link();
  void note_standstill();
  std::string fault_message(sim::LoopEnd end) const;
  void report_fault(const std::string& words);
  void publish_state(SessionState state);
  void publish_to_device_port();
  void finish();
  void end_with_fault(const std::string& words, const std::optional<LiveState::StartFailure>& start_failure);
  void end(SessionState state, const std::string& fault, nlohmann::json metrics);

  const std::string id_;
  const Simulation& simulation_;  ///< its bone and state are the loop's until it has ended
  LoopRings& rings_;
  sim::HapticLoop& loop_;
  device::DevicePort* const device_port_;
  LiveState& state_;

  // The thread's.
  stream::MeshPublisher publisher_;
  stream::TelemetryBatcher batcher_;
  score::LiveScore live_score_;
  stream::TelemetrySample sample_;   ///< the newest
  sim::BlackBox recent_;             ///< the last seconds, for faults that do not end the session
  int64_t metrics_due_ns_ = 0;       ///< when metrics are published next
  int64_t standstill_since_ns_ = 0;  ///< 0: the loop has not stood still
  bool failover_reported_ = false, device_lost_ = false;
  bool held_ = false;                                 ///< in the newest tick
  device::LinkState link_ = device::LinkState::lost;  ///< in the newest tick

  // Set by begin() before LiveState::begin(), the thread's from then on.
  SessionStatus status_;  ///< as it was published last
  std::unique_ptr<sim::CpuAllocator::Reservation> cpu_reservation_;
  std::unique_ptr<SessionFiles> files_;  ///< until the end

  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace ream::session
