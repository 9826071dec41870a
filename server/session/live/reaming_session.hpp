#pragma once
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "device/crash_guard.hpp"
#include "device/network/device_socket.hpp"
#include "openigtlink/active_session.hpp"
#include "score/live_score.hpp"
#include "session/live/loop_rings.hpp"
#include "session/live/resume_point.hpp"
#include "session/live/session_files.hpp"
#include "session/running_session.hpp"
#include "session/simulation/simulation.hpp"
#include "sim/cpu_allocator.hpp"
#include "sim/haptic_loop.hpp"
#include "stream/fanout.hpp"
#include "stream/mesh_publisher.hpp"

namespace ream::session {

/// What all sessions of one server share.
struct SessionContext {
  std::filesystem::path data;
  uint64_t server_epoch = 0;  ///< differs after each start of the server
  std::string backend = "auto";
  sim::Realtime realtime = sim::Realtime::attempt;
  std::shared_ptr<sim::CpuAllocator> places = std::make_shared<sim::CpuAllocator>();
  double tool_spacing_mm = 0.2;                                    ///< of the points that feel bone
  std::shared_ptr<openigtlink::ActiveSession> showcase = nullptr;  ///< null: nobody watches over OpenIGTLink
  int64_t (*guard_now_ns)() = steady_ns;  ///< the clock by which each loop is watched; see sim::LoopGuard
};

/// A live session: the haptic loop on its own thread, and one follower thread that keeps files, metrics,
/// telemetry and the streamed surface up to date. The bone is on its viewers' screens before it starts.
class ReamingSession final : public RunningSession {
 public:
  /// Errors: those of Simulation.
  ReamingSession(const SessionContext& context, const SessionRequest& request);
  /// Goes on with one that was interrupted or stopped, under the same id; see SessionResumer. Errors:
  /// those of ResumePoint and Simulation.
  ReamingSession(const SessionContext& context, const SessionRequest& request, const std::string& reamer);
  ~ReamingSession() override;

  void start() override;
  void pause() override;
  void unpause() override;
  void stop() override;
  bool relabel(const SessionRequest& request) override;
  SessionStatus status() const override;
  nlohmann::json metrics() const override;
  Annotation annotate(const NewAnnotation& note) override;
  std::vector<Annotation> annotations() const override;
  void write_surface(const std::filesystem::path& ply, int stride) override;
  void write_picture(const std::filesystem::path& png) override;
  std::unique_ptr<net::WebSocketSession> subscribe(int stride) override;
  std::unique_ptr<net::WebSocketSession> connect_device() override;

 private:
  /// What a session is made of, new or going on.
  struct Beginning {
    std::unique_ptr<ResumePoint> from;          ///< empty: new
    bool changed_tool = false;                  ///< since it ended
    SessionState before = SessionState::fault;  ///< it is this again when it cannot be started
    SimulationSetup parts;
  };
  static Beginning resumed(const SessionContext& context, const SessionRequest& request,
                           const std::string& reamer);
  ReamingSession(const SessionContext& context, const SessionRequest& request, Beginning beginning);

  void open_files();
  void write_running(const SessionFiles& files) const;
  void hold(bool held);
  std::vector<uint8_t> coverage_now();
  case_::Case intact_case() const;
  void copy_coverage_if_wanted();
  nlohmann::json told_of(SessionState state, const std::string& fault) const;
  void follow_to_the_end();
  void follow();
  void follow_once();
  std::string start_failure() const;
  void take(bool ended);
  void take_report(const record::TickReport& report);
  void publish_state(SessionState state);
  void note_health();
  void finish();
  void note_events(const record::TickReport& report);
  void note_standstill();
  std::string end_words(sim::LoopEnd end) const;
  void tell_fault(const std::string& words);
  void keep_black_box(const sim::BlackBox& box) const;
  void append_missing_remarks();
  void end_without_force(const std::string& words);
  void close(SessionState state, const std::string& fault, const nlohmann::json& metrics);
  stream::HelloInfo hello() const;
  void show() const;
  std::shared_ptr<device::DevicePort> port_of_device() const;
  void note_device();
  void tell_port();

  const SessionContext context_;
  const SessionRequest request_;
  const std::string id_;
  const std::filesystem::path folder_;
  std::unique_ptr<ResumePoint> from_;  ///< until started, where it goes on with another
  const bool changed_tool_;
  const SessionState state_without_start_;
  std::optional<FileLock> lock_;  ///< of the folder, while it runs
  Simulation simulation_;
  LoopRings rings_;
  const double rehearsed_us_;                              ///< slow ticks of this session, before the first
  std::unique_ptr<sim::CpuAllocator::Reservation> place_;  ///< of the loop while it runs
  sim::HapticLoop loop_;
  std::shared_ptr<device::DevicePort> port_;  ///< of devices that connect over the network
  std::shared_ptr<stream::Fanout> fanout_;
  stream::MeshPublisher publisher_;
  score::LiveScore live_score_;  ///< follower only
  int64_t metrics_due_ns_ = 0;   ///< when metrics_ are written down next; follower only
  stream::TelemetryBatcher batcher_;
  stream::TelemetrySample sample_;  ///< the newest, follower only
  bool failover_told_ = false;      ///< follower only
  bool device_is_lost_ = false;     ///< follower only
  bool held_ = false;               ///< in the newest tick, follower only
  sim::BlackBox recent_;  ///< the last seconds as the follower has them, for faults that do not end it
  device::LinkState device_state_ = device::LinkState::lost;  ///< follower only
  int64_t standstill_told_ns_ = 0;  ///< follower only; 0: the loop has not stood still

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  SessionStatus status_;
  SessionRequest labels_;                            ///< the request with its labels as they are now
  bool relabelled_ = false;                          ///< for the follower to write down
  std::vector<uint8_t>* wanted_coverage_ = nullptr;  ///< for the follower to fill; null: none is wanted
  std::mutex copying_;                               ///< one such wish at a time; locked before mutex_
  nlohmann::json metrics_;
  std::unique_ptr<SessionFiles> files_;               ///< set by start(), used by the follower
  std::vector<record::ops::Annotation> remarks_;      ///< for the follower to record
  std::vector<record::ops::Annotation> annotations_;  ///< all that were accepted
  std::string start_failure_;                         ///< for the follower to end the session with
  bool leaving_ = false, finished_ = false;
  bool closing_ = false;  ///< no remark gets into the recording any more; finished_ follows
  std::mutex stopping_;   ///< one stop() at a time
  device::CrashWatch crash_watch_;
  std::thread follower_;
};

}  // namespace ream::session
