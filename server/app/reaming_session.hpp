#pragma once
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "api/running_session.hpp"
#include "app/loop_rings.hpp"
#include "app/rig.hpp"
#include "app/session_files.hpp"
#include "sim/haptic_loop.hpp"
#include "stream/fanout_local.hpp"
#include "stream/mesh_publisher.hpp"

namespace ream::app {

/// What all sessions of one server share.
struct SessionHouse {
  std::filesystem::path data;
  uint64_t server_epoch = 0;  ///< differs after each start of the server
  std::string backend = "auto";
  sim::Realtime realtime = sim::Realtime::attempt;
};

/// A live session: the haptic loop on its own thread, and one follower thread that keeps files, metrics,
/// telemetry and the streamed surface up to date. The bone is on its viewers' screens before it starts.
class ReamingSession final : public api::RunningSession {
 public:
  /// Errors: those of Rig.
  ReamingSession(const SessionHouse& house, const api::SessionRequest& request);
  ~ReamingSession() override;

  void start() override;
  void stop() override;
  api::SessionStatus status() const override;
  nlohmann::json metrics() const override;
  std::unique_ptr<net::WebSocketSession> subscribe(int stride) override;

 private:
  void follow();
  void take(bool ended);
  void take_report(const record::TickReport& report);
  void publish_state(api::SessionState state);
  void note_health();
  void finish();
  void fail(const std::string& words);
  stream::HelloInfo hello() const;

  const SessionHouse house_;
  const std::string id_;
  Rig rig_;
  LoopRings rings_;
  sim::HapticLoop loop_;
  std::shared_ptr<stream::LocalFanout> fanout_;
  stream::MeshPublisher publisher_;
  stream::TelemetryBatcher batcher_;
  stream::TelemetrySample sample_;  ///< the newest, follower only
  bool failover_told_ = false;      ///< follower only

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  api::SessionStatus status_;
  nlohmann::json metrics_;
  std::unique_ptr<SessionFiles> files_;  ///< set by start(), used by the follower
  bool leaving_ = false, finished_ = false;
  std::mutex stopping_;  ///< one stop() at a time
  std::thread follower_;
};

}  // namespace ream::app
